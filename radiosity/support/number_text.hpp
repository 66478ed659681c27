// SPDX-License-Identifier: MIT
#pragma once

// Numbers in sentences.

#include <array>
#include <charconv>
#include <string>

namespace radiosity {

// The fewest digits that read back as the same number.
[[nodiscard]] inline std::string number_text(double x) {
  std::array<char, 40> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr};
}

}  // namespace radiosity
