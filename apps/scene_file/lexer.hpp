// SPDX-License-Identifier: MIT
#pragma once

// Divides scene text into tokens. Spaces and tabs separate them; '#' begins a comment that extends to the end of the line;
// lines end with LF, CR LF or CR. Text is UTF-8; an invalid byte (NUL and other control characters, broken UTF-8) is reported
// once and ends the text, because what follows would be meaningless.
//
// A token that begins with a digit, sign or point is a number, which the parser reads; any other one is a word. Text in double quotes is
// one word, including blanks.

#include <string>
#include <string_view>

#include "apps/scene_file.hpp"

namespace apps::scene_file {

struct Token {
  enum class Kind { word, number, open, close, end_of_line, end_of_file };
  Kind kind = Kind::end_of_file;
  std::string_view text;
  Place place;
};

class Lexer {
 public:
  Lexer(std::string_view text, Errors& errors);

  [[nodiscard]] Token next();
  // Did the text end at an invalid byte? The error has been reported.
  [[nodiscard]] bool broken() const { return broken_; }

 private:
  void skip_blank();
  void advance();
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] Token single(Token::Kind kind, std::size_t bytes);

  std::string_view text_;
  std::size_t at_ = 0;
  Place place_;
  Errors& errors_;
  bool broken_ = false;
};

// The text in quotes for a message; at most 40 characters of it.
[[nodiscard]] std::string in_quotes(std::string_view text);

// A description of the token after "found": 'reflectence', the number 3, the end of the line.
[[nodiscard]] std::string describe(const Token& token);

[[nodiscard]] std::string to_string(Place place);

}  // namespace apps::scene_file
