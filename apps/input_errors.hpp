// SPDX-License-Identifier: MIT
#pragma once

// What is wrong with a text that was read: scenes and meshes of every format have the same list, and say it in the same words. Reading
// does not stop at the first error; it ends after `max_errors` of them.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace apps {

inline constexpr std::size_t max_errors = 20;

// Line and column count from 1; a column is a character (not a byte) of the line. In a binary file the line is 0 and the column the byte,
// from 1.
struct Place {
  std::uint32_t line = 1;
  std::uint32_t column = 1;

  friend bool operator==(const Place&, const Place&) = default;
};

// Of a byte of a text whose lines end with LF; here a column is a byte.
[[nodiscard]] inline Place place_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t last = before.rfind('\n');
  return {static_cast<std::uint32_t>(1 + std::count(before.begin(), before.end(), '\n')),
          static_cast<std::uint32_t>(last == before.npos ? before.size() + 1 : before.size() - last)};
}

struct InputError {
  Place place;
  std::string sentence;
};

struct ErrorReport {
  std::vector<InputError> errors;  // in the order of the file
  bool more_errors = false;        // reading was given up at max_errors
};

// One line per error: "box.scene:12:8: error: ..."; the last line says so when more were found.
[[nodiscard]] inline std::string to_text(const ErrorReport& report, std::string_view name) {
  std::string text;
  for (const auto& [place, sentence] : report.errors) {
    text.append(name).append(place.line == 0 ? ":byte " : ":");
    if (place.line > 0) { text.append(std::to_string(place.line)).append(":"); }
    text.append(std::to_string(place.column));
    text.append(": error: ").append(sentence).append("\n");
  }
  if (report.more_errors) {
    text.append(name).append(": given up after ").append(std::to_string(report.errors.size())).append(" errors\n");
  }
  return text;
}

// The errors of one file while it is read. Never holds more than max_errors; then full() is true and reading stops.
class Errors {
 public:
  void add(Place place, std::string sentence) {
    if (list_.size() < max_errors) {
      list_.push_back({place, std::move(sentence)});
    } else {
      full_ = true;
    }
  }
  [[nodiscard]] std::size_t count() const { return list_.size(); }
  [[nodiscard]] bool full() const { return full_; }
  // The last error lies there, so that what stands there need not be blamed twice.
  [[nodiscard]] bool just_reported(Place place) const { return !list_.empty() && list_.back().place == place; }

  // Sorted by place. What is in a group of a scene is looked at once for every use: an error that was found again is told once.
  [[nodiscard]] ErrorReport take() {
    const auto place = [](const InputError& e) { return std::tie(e.place.line, e.place.column); };
    std::stable_sort(list_.begin(), list_.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    const auto same = [](const InputError& a, const InputError& b) { return a.place == b.place && a.sentence == b.sentence; };
    list_.erase(std::unique(list_.begin(), list_.end(), same), list_.end());
    return {std::move(list_), full_};
  }

 private:
  std::vector<InputError> list_;
  bool full_ = false;
};

}  // namespace apps
