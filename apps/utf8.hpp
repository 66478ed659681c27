// SPDX-License-Identifier: MIT
#pragma once

// UTF-8 (Unicode 15, table 3-7), for texts that come from outside.

#include <cstddef>
#include <string>
#include <string_view>

namespace apps {

// Length in bytes of the character that begins at text[at]; 0 when it is none: overlong forms, surrogates and code points beyond U+10FFFF.
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

// The text with U+FFFD, the replacement character, in place of every byte that belongs to no character. Names of files may hold any bytes.
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
