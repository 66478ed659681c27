// SPDX-License-Identifier: MIT
#pragma once

// The program as a process: its exit codes, the signals that may end it early, and its progress messages on stderr.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include <unistd.h>

namespace apps {

// As in CMakeLists.txt; HALFLIGHT_VERSION is set there.
#ifdef HALFLIGHT_VERSION
inline constexpr const char* version = HALFLIGHT_VERSION;
#else
inline constexpr const char* version = "unknown";
#endif

// How the program ends; also documented in `halflight --help`.
enum class ExitCode : int {
  ok = 0,
  failure = 1,        // cannot read or write a file, out of memory, interrupted with nothing to show
  usage = 2,          // the command line is wrong
  invalid_input = 3,  // the scene file or the mesh is wrong; the output says where
  not_converged = 4,  // an error target or the residual was not reached, or interrupted; results were written nevertheless
};

// Reserves the stack that the main thread may need, or throws bad_alloc. The system otherwise allocates it on use, and if the process may
// have no more memory then, a signal ends the process instead of an exception. Other threads have their stacks from the start.
void claim_stack();

// --- signals
//
// Whatever ends the program (Ctrl-C, kill, a closed terminal, a time limit), a file that is being written is removed first.
//
// A command that can stop early calls watch_interrupts(). The first signal then sets a flag that the solver and the picture check, and
// the command ends without half-written files; a second signal ends the program at once. Without this call the first one does.
//
// A write beyond the file size limit or to a closed pipe raises no signal but fails with an error.

// Installs the handlers. Must be called once, before anything else.
void guard_process();

// From now on the first signal sets the flag.
const std::atomic<bool>& watch_interrupts();

// --- progress messages on stderr
//
// On a terminal, one line with a bar that is redrawn in place at most 20 times a second; elsewhere one line per stage. Prints nothing if
// quiet. Results are never printed here: they belong to stdout.
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

  // Prints one line.
  void say(const std::string& sentence) {
    if (quiet_) { return; }
    done();
    std::fprintf(stderr, "halflight: %s\n", sentence.c_str());
  }

  // Erases the bar.
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
