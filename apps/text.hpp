// SPDX-License-Identifier: MIT
#pragma once

// Formatting of numbers, lists and columns for the output of commands, parsing of numbers, and UTF-8 (Unicode 15, table 3-7) for texts
// from outside.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include <radiosity/support/number_text.hpp>

namespace apps {

// The number that the whole text represents, without a '+' or blanks; nothing otherwise.
template <class Number>
[[nodiscard]] std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  return code == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// Is the word one of the list?
template <class List>
[[nodiscard]] bool contains(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// "face" or "faces". `several`: the plural, if it is not `one` with an s.
[[nodiscard]] inline std::string plural(std::size_t count, const std::string& one, const std::string& several = {}) {
  return count == 1 ? one : several.empty() ? one + "s" : several;
}
// "1 face", "2 faces".
[[nodiscard]] inline std::string counted(std::size_t count, const std::string& one, const std::string& several = {}) {
  return std::to_string(count) + " " + plural(count, one, several);
}

// "a, b, c"; empty items are left out.
template <class List>
[[nodiscard]] std::string joined(const List& items, std::string_view between = ", ") {
  std::string text;
  for (const std::string_view item : items) {
    if (!item.empty()) { text.append(text.empty() ? "" : between).append(item); }
  }
  return text;
}

// Applies one printf conversion to a double: formatted("%.3g", x).
[[nodiscard]] inline std::string formatted(const char* format, double x) {
  std::array<char, 400> text{};  // %f of the largest double has 309 digits before the point
  std::snprintf(text.data(), text.size(), format, x);
  return text.data();
}

// fixed() has this many decimals; trimmed() drops zeros at the end, as for coordinates of a drawing: "1.5", "2", "0".
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

// The fewest digits that read back as the same number.
[[nodiscard]] inline std::string shortest(double x) { return radiosity::number_text(x); }

// 1234567 as "1 234 567".
[[nodiscard]] inline std::string grouped(std::uint64_t count, const char* between = " ") {
  std::string digits = std::to_string(count);
  for (std::size_t at = digits.size(); at > 3; at -= 3) { digits.insert(at - 3, between); }
  return digits;
}

// Divides x by 1000 as long as it is at least `limit`, but up to four times; returns the SI prefix of what is left: "", "k", "M", "G", "T".
inline std::string take_prefix(double& x, double limit) {
  static constexpr std::array<const char*, 5> prefixes = {"", "k", "M", "G", "T"};
  std::size_t i = 0;
  for (; x >= limit && i + 1 < prefixes.size(); ++i) { x /= 1000.0; }
  return prefixes[i];
}

// 0.0123 as "1.23 %".
[[nodiscard]] inline std::string percent(double part) { return formatted("%.3g %%", 100.0 * part); }

// A vector of three: "1 0.5 2".
template <class Vector>
[[nodiscard]] std::string triple(const Vector& v) {
  return formatted("%.6g", v.x) + " " + formatted("%.6g", v.y) + " " + formatted("%.6g", v.z);
}

// The last line of a list of `count` items of which `shown` are printed; empty if that is all.
[[nodiscard]] inline std::string and_more(std::size_t count, std::size_t shown, const std::string& remark = {}) {
  return shown < count ? "  ... and " + std::to_string(count - shown) + " more" + remark + "\n" : std::string();
}

// Pads the text with blanks after it (left) or before it (right) to `width` characters, with at least `gap` blanks.
[[nodiscard]] inline std::string left(std::string text, std::size_t width, std::size_t gap = 2) {
  text.resize(std::max(text.size() + gap, width), ' ');
  return text;
}
[[nodiscard]] inline std::string right(const std::string& text, std::size_t width, std::size_t gap = 2) {
  return std::string(std::max(width, text.size() + gap) - text.size(), ' ') + text;
}

// The text without the byte order mark with which some programs begin UTF-8.
[[nodiscard]] constexpr std::string_view without_mark(std::string_view text) {
  return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
}

// Length in bytes of the character that begins at text[at]; 0 if it is invalid: overlong forms, surrogates, code points beyond U+10FFFF.
[[nodiscard]] constexpr std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : static_cast<unsigned char>(0);
  };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xbf) { return byte(i) >= low && byte(i) <= high; };
  const unsigned first = byte(0);
  if (first < 0x80) { return 1; }
  if (first >= 0xc2 && first <= 0xdf) { return follows(1) ? 2 : 0; }
  if (first >= 0xe0 && first <= 0xef) {
    const bool second = follows(1, first == 0xe0 ? 0xa0 : 0x80, first == 0xed ? 0x9f : 0xbf);
    return second && follows(2) ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    const bool second = follows(1, first == 0xf0 ? 0x90 : 0x80, first == 0xf4 ? 0x8f : 0xbf);
    return second && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

// Replaces every byte that belongs to no character by U+FFFD, the replacement character. Names of files may contain any bytes.
[[nodiscard]] inline std::string to_utf8(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    length == 0 ? result.append("\xef\xbf\xbd") : result.append(text.substr(at, length));
    at += length == 0 ? 1 : length;
  }
  return result;
}

}  // namespace apps
