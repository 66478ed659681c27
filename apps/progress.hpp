// SPDX-License-Identifier: MIT
#pragma once

// Narration on stderr: on a terminal one line with a bar that is drawn over itself, at most 20 times a second;
// elsewhere one line per stage. Silent when quiet. Results never go this way: they belong to stdout.

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include <unistd.h>

namespace apps {

class Progress {
 public:
  explicit Progress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { done(); }

  // `fraction` of the stage is done, 0 to 1.
  void report(std::string_view stage, double fraction) {
    if (quiet_) { return; }
    const bool is_new = stage != stage_;
    stage_ = stage;
    if (!terminal_) {
      if (is_new) { std::fprintf(stderr, "halflight: %s\n", stage_.c_str()); }
      return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!is_new && fraction < 1.0 && now - drawn_ < std::chrono::milliseconds(50)) { return; }
    drawn_ = now;
    constexpr int width = 40;
    const int filled = static_cast<int>(width * (fraction < 0.0 ? 0.0 : fraction > 1.0 ? 1.0 : fraction));
    std::string bar(static_cast<std::size_t>(filled), '#');
    bar.resize(width, '-');
    std::fprintf(stderr, "\r%-12s [%s] %3d %%", stage_.c_str(), bar.c_str(), 100 * filled / width);
    std::fflush(stderr);
    shown_ = true;
  }

  // One line of narration.
  void say(const std::string& sentence) {
    if (quiet_) { return; }
    done();
    std::fprintf(stderr, "halflight: %s\n", sentence.c_str());
  }

  // Wipes the bar.
  void done() {
    if (shown_) { std::fprintf(stderr, "\r%60s\r", ""); }
    shown_ = false;
    stage_.clear();
  }

 private:
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  std::string stage_;
  std::chrono::steady_clock::time_point drawn_;
};

}  // namespace apps
