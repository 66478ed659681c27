// SPDX-License-Identifier: MIT
#pragma once

// Divides VRML text into tokens: words, strings and marks. Blanks and commas separate them; a comment extends from '#' to the end of its
// line. VRML 97 has fewer marks, because its names may contain parentheses.

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "apps/input_errors.hpp"
#include "apps/mesh_file/reading.hpp"
#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {

class Tokens {
 public:
  Tokens(std::string_view text, Version version) : text_(text), marks_(version == Version::v97 ? "{}[]" : "{}[]()|") { next(); }

  // The present token: a word, a mark, or a string with its quotes; empty at the end.
  [[nodiscard]] std::string_view token() const { return token_; }
  [[nodiscard]] Place place() const { return at_; }
  [[nodiscard]] bool is(std::string_view text) const { return token_ == text; }
  [[nodiscard]] bool at_end() const { return token_.empty(); }
  [[nodiscard]] bool is_string() const { return !token_.empty() && token_[0] == '"'; }
  [[nodiscard]] bool is_word() const { return !at_end() && !is_string() && marks_.find(token_[0]) == marks_.npos; }

  void next() {
    skip();
    at_ = {line_, static_cast<std::uint32_t>(i_ - line_begin_ + 1)};
    const std::size_t begin = i_;
    if (i_ >= text_.size()) {
      token_ = {};
    } else if (text_[i_] == '"') {
      for (++i_; i_ < text_.size() && text_[i_] != '"'; ++i_) {
        if (text_[i_] == '\\' && i_ + 1 < text_.size()) { ++i_; }
        line_end();
      }
      i_ = std::min(i_ + 1, text_.size());
      token_ = text_.substr(begin, i_ - begin);
    } else if (marks_.find(text_[i_]) != marks_.npos) {
      token_ = text_.substr(i_++, 1);
    } else {
      while (i_ < text_.size() && !is_blank(text_[i_]) && text_[i_] != '"' && text_[i_] != '#' && marks_.find(text_[i_]) == marks_.npos) {
        ++i_;
      }
      token_ = text_.substr(begin, i_ - begin);
    }
  }

 private:
  static bool is_blank(char c) { return static_cast<unsigned char>(c) <= 0x20 || c == ','; }
  // Lines end with LF, CR LF or CR.
  void line_end() {
    if (text_[i_] != '\n' && (text_[i_] != '\r' || text_.substr(i_ + 1, 1) == "\n")) { return; }
    ++line_;
    line_begin_ = i_ + 1;
  }
  void skip() {
    for (bool comment = false; i_ < text_.size() && (comment || is_blank(text_[i_]) || text_[i_] == '#'); ++i_) {
      comment = text_[i_] == '#' || (comment && text_[i_] != '\n' && text_[i_] != '\r');
      line_end();
    }
  }

  std::string_view text_, marks_, token_;
  std::size_t i_ = 0, line_begin_ = 0;
  std::uint32_t line_ = 1;
  Place at_;
};

// Also accepts hexadecimal numbers.
inline std::optional<double> number_of(std::string_view word) {
  if (word.starts_with("0x") || word.starts_with("0X")) {
    std::uint32_t value = 0;
    const auto [end, code] = std::from_chars(word.data() + 2, word.data() + word.size(), value, 16);
    return code == std::errc() && end == word.data() + word.size() ? std::optional<double>(value) : std::nullopt;
  }
  return mesh_file::to_number(word);
}

// The content of a string token, or a word unchanged. A backslash stands for itself but before a quote or another one: in "..\rooms" it
// divides a path.
inline std::string unquoted(std::string_view token) {
  if (token.empty() || token[0] != '"') { return std::string(token); }
  token.remove_prefix(1);
  if (!token.empty() && token.back() == '"') { token.remove_suffix(1); }
  std::string text;
  for (std::size_t i = 0; i < token.size(); ++i) {
    if (token[i] == '\\' && i + 1 < token.size() && (token[i + 1] == '"' || token[i + 1] == '\\')) { ++i; }
    text += token[i];
  }
  return text;
}

}  // namespace apps::vrml
