// SPDX-License-Identifier: MIT
#pragma once

// The words of script text: characters, handles, and how messages name them. See euler_script_parse.hpp.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <brep/euler_script.hpp>

namespace brep {

namespace detail {

[[nodiscard]] inline bool is_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }
[[nodiscard]] inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

// The length of the UTF-8 character at the start of `text`, 0 when there is none or when it is a control character.
[[nodiscard]] inline std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) { return (first >= 0x20 && first != 0x7f) || first == '\t' ? 1 : 0; }
  const std::size_t n = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) { return 0; }
  for (std::size_t i = 1; i < n; ++i) {
    if ((byte(i) & 0xc0u) != 0x80) { return 0; }
  }
  const unsigned second = byte(1);  // no overlong forms, no surrogates, nothing beyond U+10FFFF; U+0080 to U+009F are controls
  if ((first == 0xc2 && second < 0xa0) || (first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0)) { return 0; }
  if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90)) { return 0; }
  if (first == 0xef && second == 0xbf && byte(2) >= 0xbe) {
    return 0;  // U+FFFE and U+FFFF are no characters
  }
  return n;
}

// A handle as it is printed: letter and number below 2^31.
[[nodiscard]] inline Element parse_handle(std::string_view word) {
  constexpr std::string_view letters = "hvf";
  if (word.size() < 2 || word.size() > 11 || letters.find(word[0]) == letters.npos) { return {}; }
  std::uint64_t index = 0;
  for (char c : word.substr(1)) {
    if (c < '0' || c > '9') { return {}; }
    index = 10 * index + static_cast<std::uint64_t>(c - '0');
  }
  if (index >= 0x80000000u || (word[1] == '0' && word.size() > 2)) { return {}; }
  Element element;
  element.letter = word[0];
  element.index = static_cast<std::uint32_t>(index);
  return element;
}

[[nodiscard]] inline const char* kind_name(char letter) {
  return letter == 'h' ? "a half-edge" : letter == 'v' ? "a vertex" : letter == 'f' ? "a face" : "a face or a vertex";
}
[[nodiscard]] constexpr char result_kind(Function f) { return f == Function::face ? 'f' : f == Function::vertex ? 'v' : 'h'; }
[[nodiscard]] inline char result_kind(const Statement& s) { return s.command == Command::apply ? form(s.op).result : '\0'; }
[[nodiscard]] inline std::string_view argument_kinds(const Statement& s) {
  return s.command == Command::apply ? form(s.op).arguments : std::string_view();
}
[[nodiscard]] inline std::string command_name(const Statement& s) {
  return std::string(s.command == Command::apply ? name(s.op) : command_names[static_cast<std::size_t>(s.command)]);
}

template <class Names>
[[nodiscard]] std::optional<std::size_t> find_word(const Names& names, std::string_view word) {
  const auto at = std::find(names.begin(), names.end(), word);
  if (at == names.end()) { return std::nullopt; }
  return static_cast<std::size_t>(at - names.begin());
}

[[nodiscard]] inline std::string quoted(std::string_view text) {
  std::size_t n = std::min<std::size_t>(text.size(), 40);
  while (n < text.size() && n > 0 && (static_cast<unsigned char>(text[n]) & 0xc0u) == 0x80) {
    --n;  // whole characters
  }
  return "'" + std::string(text.substr(0, n)) + (n < text.size() ? "...'" : "'");
}

}  // namespace detail

}  // namespace brep
