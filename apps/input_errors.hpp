// SPDX-License-Identifier: MIT
#pragma once

// Errors in a text that was read: scenes and meshes of all formats use the same list and the same wording. Reading does not stop at the
// first error but after `max_errors` of them.

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

// Line and column count from 1; a column is a character of the line, not a byte. In a binary file the line is 0 and the column is the
// byte, counted from 1.
struct Place {
  std::uint32_t line = 1;
  std::uint32_t column = 1;

  friend bool operator==(const Place&, const Place&) = default;
};

// The place of a byte in a text whose lines end with LF; the column here is a byte.
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
  bool more_errors = false;        // reading stopped at max_errors
};

// One line per error: "box.scene:12:8: error: ..."; a last line says so if more were found.
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

// Only the first error, without the end of its line.
[[nodiscard]] inline std::string first_error(const ErrorReport& report, std::string_view name) {
  const std::string all = to_text(report, name);
  return all.substr(0, all.find('\n'));
}

// The errors of one file while it is read. Contains at most max_errors; then full() is true and reading stops.
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
  // Is this the place of the last error? Then what stands there need not be reported twice.
  [[nodiscard]] bool just_reported(Place place) const { return !list_.empty() && list_.back().place == place; }

  // Sorted by place, without duplicates: the contents of a scene's group are checked once per use, so an error there is found several
  // times.
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
