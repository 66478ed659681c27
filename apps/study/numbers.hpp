// SPDX-License-Identifier: MIT
#pragma once

// Numbers as text for people. A value that was not measured (NaN) is a dash.

#include <cmath>
#include <cstdint>
#include <string>

#include "apps/text.hpp"

namespace study {

// With a true minus sign.
[[nodiscard]] inline std::string fixed(double x, int decimals) {
  if (!std::isfinite(x)) { return "–"; }
  const std::string text = apps::fixed(std::abs(x), decimals);
  return (x < 0.0 && text.find_first_of("123456789") != text.npos ? "−" : "") + text;
}

[[nodiscard]] inline std::string signed_number(double x) { return (std::isfinite(x) && x >= 0.0 ? "+" : "") + fixed(x, 2); }

// Three significant digits, without an exponent between 0.001 and a million.
[[nodiscard]] inline std::string figure(double x) {
  if (!std::isfinite(x)) { return "–"; }
  const double size = std::abs(x);
  if (size >= 0.001 && size < 999500.0) {
    const int digits = static_cast<int>(std::floor(std::log10(size * (1.0 + 1e-9))));
    return fixed(x, digits >= 2 ? 0 : 2 - digits);
  }
  return apps::formatted("%.3g", x);
}

// For the ticks of an axis: as few characters as possible.
[[nodiscard]] inline std::string short_number(double x) {
  const std::string prefix = apps::take_prefix(x, 1000.0 * (1.0 - 1e-9));
  return apps::formatted("%.4g", x) + (prefix.empty() ? "" : " ") + prefix;
}

// 0.0123 -> "1.23 %".
[[nodiscard]] inline std::string percent(double fraction) {
  if (!std::isfinite(fraction)) { return "–"; }
  if (std::abs(fraction) >= 9.995) { return fixed(100.0 * fraction, 0) + " %"; }
  const std::string number = apps::formatted("%.3g", 100.0 * fraction);
  if (number.find('e') == number.npos || std::abs(fraction) <= 1e-9 || std::abs(fraction) >= 1.0) { return number + " %"; }
  return apps::trimmed(100.0 * fraction, 2 - static_cast<int>(std::floor(std::log10(std::abs(100.0 * fraction))))) + " %";
}

// 12 300 000 -> "12.3 MB", with powers of 1000 as for disks.
[[nodiscard]] inline std::string bytes_text(std::uint64_t bytes) {
  auto x = static_cast<double>(bytes);
  const std::string prefix = apps::take_prefix(x, 999.5);
  return (prefix.empty() ? fixed(x, 0) : figure(x)) + " " + prefix + "B";
}

// 9 876, 12.3 k, 1.23 M; the space between digits is narrow and non-breaking.
[[nodiscard]] inline std::string count_text(std::uint64_t count) {
  if (count < 10000) { return apps::grouped(count, "\u202f"); }
  auto x = static_cast<double>(count);
  const std::string prefix = apps::take_prefix(x, 999.5);
  return figure(x) + " " + prefix;
}

}  // namespace study
