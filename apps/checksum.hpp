// SPDX-License-Identifier: MIT
#pragma once

// FNV-1a of 64 bits (Fowler, Noll and Vo 1991): finds files that were damaged by accident, not by intent.

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace apps {

class Checksum {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) { state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull; }
  }
  void add(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) { state_ = (state_ ^ (number >> shift & 0xff)) * 0x100000001b3ull; }
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

  // Sixteen hexadecimal digits.
  [[nodiscard]] std::string text() const {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) { digits += hex[state_ >> shift & 15]; }
    return digits;
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace apps
