// SPDX-License-Identifier: MIT
#pragma once

// Numbers, lists and columns as text, for what the commands print; and text as numbers.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace apps {

// The number that is the whole text, without sign '+' or blanks; nothing otherwise.
template <class Number>
[[nodiscard]] std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  return code == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// "a, b, c"; what is empty is left out.
template <class List>
[[nodiscard]] std::string joined(const List& items, std::string_view between = ", ") {
  std::string text;
  for (const std::string_view item : items) {
    if (!item.empty()) { text.append(text.empty() ? "" : between).append(item); }
  }
  return text;
}

// By one printf conversion of a double: formatted("%.3g", x).
[[nodiscard]] inline std::string formatted(const char* format, double x) {
  std::array<char, 400> text{};  // %f of the largest double has 309 digits before the point
  std::snprintf(text.data(), text.size(), format, x);
  return text.data();
}

// With so many decimals; without zeros at its end, as coordinates of a drawing are written: "1.5", "2", "0".
[[nodiscard]] inline std::string fixed(double x, int decimals) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, x);
  return text.data();
}
[[nodiscard]] inline std::string trimmed(double x, int decimals) {
  std::string text = fixed(x, decimals);
  if (decimals > 0) { text.erase(text.find_last_not_of('0') + 1); }
  if (text.back() == '.') { text.pop_back(); }
  return text == "-0" ? "0" : text;
}

// With the fewest digits that read back as the same number.
[[nodiscard]] inline std::string shortest(double x) {
  std::array<char, 40> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr};
}

// 0.0123 as "1.23 %".
[[nodiscard]] inline std::string percent(double part) { return formatted("%.3g %%", 100.0 * part); }

// A vector of three: "1 0.5 2".
template <class Vector>
[[nodiscard]] std::string triple(const Vector& v) {
  return formatted("%.6g", v.x) + " " + formatted("%.6g", v.y) + " " + formatted("%.6g", v.z);
}

// The last line of a list of `count` of which `shown` are printed: empty when that is all.
[[nodiscard]] inline std::string and_more(std::size_t count, std::size_t shown, const std::string& remark = {}) {
  return shown < count ? "  ... and " + std::to_string(count - shown) + " more" + remark + "\n" : std::string();
}

// Filled with blanks behind, or before, to `width` characters; at least `gap` of them.
[[nodiscard]] inline std::string left(std::string text, std::size_t width, std::size_t gap = 2) {
  text.resize(std::max(text.size() + gap, width), ' ');
  return text;
}
[[nodiscard]] inline std::string right(const std::string& text, std::size_t width, std::size_t gap = 2) {
  return std::string(std::max(width, text.size() + gap) - text.size(), ' ') + text;
}

}  // namespace apps
