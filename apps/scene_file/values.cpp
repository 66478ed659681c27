// SPDX-License-Identifier: MIT
// The smallest parts of a scene file: tokens, numbers, names, and the recovery after an error.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "apps/scene_file/parser.hpp"
#include "apps/text.hpp"

namespace apps::scene_file {
namespace {

bool is_name(std::string_view text) {
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    if (!letter && !(c >= '0' && c <= '9') && c != '_' && c != '-') { return false; }
  }
  return text.size() <= 200;
}

// Number of digits of a decimal number from the first that is not 0, without the exponent. "0.0120" has three.
std::size_t significant_digits(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) {
    if (c == 'e' || c == 'E') { break; }
    if (c >= '0' && c <= '9' && (count > 0 || c != '0')) { ++count; }
  }
  return count;
}

// Empty if `text` is a well-formed finite number not beyond `most`; else describes the fault.
std::string number_fault(std::string_view text, double most, double& out) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  if (plus) { text.remove_prefix(1); }
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), out);
  const bool whole = end == text.data() + text.size();
  if (whole && code == std::errc::result_out_of_range) { return "is beyond what a number can hold"; }
  if (!whole || code != std::errc()) {
    return text.find(',') != text.npos ? "is not a number; numbers are separated by spaces" : "is not a number";
  }
  if (!std::isfinite(out)) { return "is not a finite number"; }
  if (std::abs(out) > most) { return "is too large; numbers lie between -1e30 and 1e30"; }
  return {};
}

}  // namespace

void Parser::next() {
  if (errors_.full()) {
    token_ = {Token::Kind::end_of_file, {}, token_.place};
  } else {
    token_ = lexer_.next();
  }
}

void Parser::skip_rest() {
  while (at(Token::Kind::word) || at(Token::Kind::number)) { next(); }
}

void Parser::skip_statement() {
  skip_rest();
  if (at(Token::Kind::open)) { skip_block(); }
}

void Parser::skip_to_next() {
  skip_statement();
  expect_end_of_line();
}

void Parser::skip_block() {
  const Place opened = token_.place;
  std::size_t depth = 0;
  do {
    if (at(Token::Kind::end_of_file)) { return unclosed(opened); }
    if (at(Token::Kind::open)) { ++depth; }
    if (at(Token::Kind::close)) { --depth; }
    next();
  } while (depth > 0);
}

void Parser::unclosed(Place opened) {
  if (lexer_.broken()) { return; }
  error(token_.place, "expected '}' to close the block that begins at " + to_string(opened) + ", found the end of the file");
}

void Parser::expect_end_of_line() {
  if (at(Token::Kind::end_of_line)) { return next(); }
  if (at(Token::Kind::end_of_file) || at(Token::Kind::close)) { return; }
  error(token_.place, "expected the end of the line, found " + describe(token_));
  skip_statement();
}

bool Parser::number(std::string_view clause, double& out, double most) {
  const Token found = token_;
  if (found.kind != Token::Kind::number) {
    error(found.place, "expected a number for '" + std::string(clause) + "', found " + describe(found));
    return false;
  }
  next();
  digits_ = std::max(digits_, significant_digits(found.text));
  const std::string fault = number_fault(found.text, most, out);
  if (!fault.empty()) { error(found.place, in_quotes(found.text) + " " + fault); }
  return fault.empty();
}

bool Parser::no_more_numbers(std::string_view clause, std::string_view takes) {
  if (!at(Token::Kind::number)) { return true; }
  error(token_.place, "'" + std::string(clause) + "' takes " + std::string(takes) + ", found one more: " + in_quotes(token_.text));
  while (at(Token::Kind::number)) { next(); }
  return false;
}

bool Parser::numbers(const Token& keyword, std::span<double> out) {
  const std::string takes = counted(out.size(), "number");
  bool sound = true;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!at(Token::Kind::number)) {
      error(token_.place, "'" + std::string(keyword.text) + "' takes " + takes + "; expected number " + std::to_string(i + 1) + ", found " +
                              describe(token_));
      return false;
    }
    sound = number(keyword.text, out[i]) && sound;
  }
  return no_more_numbers(keyword.text, takes) && sound;
}

bool Parser::vector(const Token& keyword, glm::dvec3& out) {
  double xyz[3] = {0.0, 0.0, 0.0};
  const bool sound = numbers(keyword, xyz);
  out = glm::dvec3(xyz[0], xyz[1], xyz[2]);
  return sound;
}

bool Parser::whole_number(std::string_view what, std::uint32_t most, std::uint32_t& out) {
  const Token found = token_;
  double value = 0.0;
  if (!number(what, value)) { return false; }
  if (value < 0.0 || value > most || value != std::floor(value)) {
    error(found.place,
          "expected a whole number from 0 to " + std::to_string(most) + " for '" + std::string(what) + "', found " + in_quotes(found.text));
    return false;
  }
  out = static_cast<std::uint32_t>(value);
  return true;
}

bool Parser::name(std::string_view of_what, Name& out) {
  const Token found = token_;
  if (found.kind != Token::Kind::word) {
    error(found.place, "expected the name of a " + std::string(of_what) + ", found " + describe(found) +
                           (found.kind == Token::Kind::number ? "; a name begins with a letter" : ""));
    return false;
  }
  next();
  out = {std::string(found.text), found.place};
  if (is_name(found.text)) { return true; }
  error(found.place, in_quotes(found.text) + " is not a name; names have letters, digits, '_' and '-', at most 200");
  return false;
}

}  // namespace apps::scene_file
