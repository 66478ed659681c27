// SPDX-License-Identifier: MIT
#include "apps/scene_file/lexer.hpp"

#include <array>
#include <cstdio>

#include "apps/text.hpp"

namespace apps::scene_file {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }
constexpr bool ends_line(char c) { return c == '\n' || c == '\r'; }
constexpr bool ends_token(char c) { return is_blank(c) || ends_line(c) || c == '#' || c == '{' || c == '}'; }
constexpr bool begins_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

// Length in bytes of the character that begins at text[at]; 0 if it is invalid.
std::size_t character_length(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  const bool control = (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7f;
  return control ? 0 : utf8_length(text, at);
}

}  // namespace

Lexer::Lexer(std::string_view text, Errors& errors) : text_(without_mark(text)), errors_(errors) {}

// Advances by one character; ends the text if it is invalid.
void Lexer::advance() {
  const std::size_t length = character_length(text_, at_);
  if (length == 0) {
    std::array<char, 80> sentence{};
    std::snprintf(sentence.data(), sentence.size(), "expected text, found the byte 0x%02x; is this a binary file?",
                  static_cast<unsigned>(static_cast<unsigned char>(text_[at_])));
    errors_.add(place_, sentence.data());
    broken_ = true;
    text_ = text_.substr(0, at_);
    return;
  }
  at_ += length;
  ++place_.column;
}

void Lexer::skip_blank() {
  while (!at_end() && is_blank(text_[at_])) { advance(); }
  if (at_end() || text_[at_] != '#') { return; }
  while (!at_end() && !ends_line(text_[at_])) { advance(); }
}

Token Lexer::single(Token::Kind kind, std::size_t bytes) {
  const Token token{kind, text_.substr(at_, bytes), place_};
  at_ += bytes;
  place_.column += 1;
  return token;
}

Token Lexer::next() {
  skip_blank();
  if (at_end()) { return {Token::Kind::end_of_file, {}, place_}; }
  const char c = text_[at_];
  if (c == '{') { return single(Token::Kind::open, 1); }
  if (c == '}') { return single(Token::Kind::close, 1); }
  if (ends_line(c)) {
    const bool two = text_.substr(at_, 2) == "\r\n";
    const Token token = single(Token::Kind::end_of_line, two ? 2 : 1);
    place_ = {place_.line + 1, 1};
    return token;
  }
  const std::size_t begin = at_;
  const Place place = place_;
  if (c == '"') {  // up to the closing quote or the end of the line
    do { advance(); } while (!at_end() && text_[at_] != '"' && !ends_line(text_[at_]));
    if (!at_end() && text_[at_] == '"') { advance(); }
    return {Token::Kind::word, text_.substr(begin, at_ - begin), place};
  }
  while (!at_end() && !ends_token(text_[at_])) { advance(); }
  if (at_ == begin) { return {Token::Kind::end_of_file, {}, place}; }
  return {begins_number(c) ? Token::Kind::number : Token::Kind::word, text_.substr(begin, at_ - begin), place};
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  if (text.size() <= longest) { return "'" + std::string(text) + "'"; }
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) { --end; }
  return "'" + std::string(text.substr(0, end)) + "...'";
}

std::string describe(const Token& token) {
  switch (token.kind) {
    case Token::Kind::end_of_line:
      return "the end of the line";
    case Token::Kind::end_of_file:
      return "the end of the file";
    default:
      return in_quotes(token.text);
  }
}

std::string to_string(Place place) { return std::to_string(place.line) + ":" + std::to_string(place.column); }

}  // namespace apps::scene_file
