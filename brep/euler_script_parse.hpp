// SPDX-License-Identifier: MIT
#pragma once

// Reads the script text of euler_script.hpp.
//
// Everything that can be known without running is checked here: the words, the number and kinds of arguments (a name has the kind
// that its operator returns), names that nobody defined. Each line with an error gives one error, and reading goes on with the next
// line, so one pass tells all. No recursion: nested functions are a list, so depth costs no stack.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <brep/euler_script.hpp>
#include <brep/euler_script_words.hpp>

namespace brep {

// Reads statements one by one and remembers the names that they define, so a session at the terminal can go on with it.
class ScriptParser {
 public:
  static constexpr std::size_t max_errors = 50;  // reading ends there: what follows a binary file's first lines is noise

  // Reads one line without its end; nothing when the line is empty, a comment, or an error.
  [[nodiscard]] std::optional<Statement> parse_line(std::string_view line, std::uint32_t number);
  [[nodiscard]] const std::vector<ScriptError>& errors() const { return errors_; }
  // The comment of the last line without '#' and one blank behind it; nothing when it had none.
  [[nodiscard]] const std::optional<std::string>& comment() const { return comment_; }

 private:
  [[nodiscard]] bool fail(std::size_t at, std::string sentence) {
    errors_.push_back({{number_, static_cast<std::uint32_t>(at + 1)}, std::move(sentence)});
    return false;
  }
  void skip() {
    while (at_ < line_.size() && detail::is_blank(line_[at_])) { ++at_; }
  }
  [[nodiscard]] bool at_end() {
    skip();
    return at_ == line_.size();
  }
  [[nodiscard]] std::string_view word() {
    skip();
    const std::size_t begin = at_;
    while (at_ < line_.size() && detail::is_word(line_[at_])) { ++at_; }
    return line_.substr(begin, at_ - begin);
  }
  [[nodiscard]] bool take(char c) {
    skip();
    if (at_ == line_.size() || line_[at_] != c) { return false; }
    ++at_;
    return true;
  }
  [[nodiscard]] std::string found() {  // what stands here, for messages
    if (at_end()) { return "the end of the line"; }
    const std::size_t begin = at_;
    if (!word().empty()) { return detail::quoted(line_.substr(begin, std::exchange(at_, begin) - begin)); }
    return detail::quoted(line_.substr(at_, std::max<std::size_t>(1, detail::character_length(line_.substr(at_)))));
  }

  bool split_comment();
  bool statement(Statement& s);
  bool expression(char kind, Expression& e);
  bool raw(Statement& s);
  bool expect(Statement& s);
  bool left_side(Statement& s, std::string_view text, std::size_t at);
  bool number(long& value);

  std::string_view line_;
  std::size_t at_ = 0;
  std::uint32_t number_ = 1;
  std::optional<std::string> comment_;
  std::map<std::string, char, std::less<>> names_;  // and their kinds
  std::vector<ScriptError> errors_;
};

inline std::optional<Statement> ScriptParser::parse_line(std::string_view line, std::uint32_t number) {
  line_ = line;
  at_ = 0;
  number_ = number;
  if (!split_comment() || at_end()) { return std::nullopt; }
  Statement s;
  s.place = {number_, static_cast<std::uint32_t>(at_ + 1)};
  s.text = line_.substr(at_);
  while (detail::is_blank(s.text.back())) { s.text.pop_back(); }
  if (!statement(s)) { return std::nullopt; }
  if (!s.result.name.empty()) { names_[s.result.name] = detail::result_kind(s); }
  return s;
}

// Checks that the line is text and cuts its comment off.
inline bool ScriptParser::split_comment() {
  comment_.reset();
  for (std::size_t i = 0; i < line_.size();) {
    const std::size_t n = detail::character_length(line_.substr(i));
    if (n == 0) { return fail(i, "found a byte that is not text; expected UTF-8 without control characters"); }
    i += n;
  }
  const std::size_t sharp = line_.find('#');
  if (sharp == line_.npos) { return true; }
  std::string_view text = line_.substr(sharp + 1);
  if (!text.empty() && detail::is_blank(text.front())) { text.remove_prefix(1); }
  while (!text.empty() && detail::is_blank(text.back())) { text.remove_suffix(1); }
  comment_ = std::string(text);
  line_ = line_.substr(0, sharp);
  return true;
}

inline bool ScriptParser::statement(Statement& s) {
  std::size_t begin = at_;
  std::string_view first = word();
  if (first == "refused") {
    s.refused = true;
    skip();
    begin = at_;
    first = word();
  }
  std::string_view left;
  std::size_t left_at = begin;
  if (!first.empty() && take('=')) {
    left = first;
    skip();
    begin = at_;
    first = word();
  }
  const OperatorForm* const known = find_operator(first);
  const auto other = detail::find_word(command_names, first);
  if (first.empty() || (known == nullptr && !other)) {
    at_ = begin;
    return fail(begin, "found " + found() + "; expected an operator such as split_face, or undo, redo, raw, expect, refused");
  }
  s.command = known != nullptr ? Command::apply : static_cast<Command>(*other);
  if (known != nullptr) {
    s.op = known->op;
    s.written = first;
  }
  if (s.refused && known == nullptr) { return fail(begin, std::string(first) + " cannot be refused; expected an operator"); }
  if (s.refused && !left.empty()) { return fail(left_at, "a refused operator has no result; leave out " + detail::quoted(left) + " ="); }
  if (!left.empty() && !left_side(s, left, left_at)) { return false; }
  if (s.command == Command::raw) { return raw(s); }
  if (s.command == Command::expect) { return expect(s); }
  for (char kind : detail::argument_kinds(s)) {
    s.arguments.emplace_back();
    if (!expression(kind, s.arguments.back())) { return false; }
  }
  if (at_end()) { return true; }
  const std::size_t n = s.arguments.size();
  return fail(at_, "found " + found() + "; expected the end of the line: " + detail::command_name(s) + " has " +
                       (n == 0   ? "no arguments"
                        : n == 1 ? "one argument"
                                 : "two arguments"));
}

inline bool ScriptParser::left_side(Statement& s, std::string_view text, std::size_t at) {
  const char kind = detail::result_kind(s);
  s.result.place = {number_, static_cast<std::uint32_t>(at + 1)};
  if (kind == 0) { return fail(at, detail::command_name(s) + " has no result; leave out " + detail::quoted(text) + " ="); }
  s.result.handle = detail::parse_handle(text);
  if (s.result.handle.letter != 0) {
    if (s.result.handle.letter == kind) { return true; }
    return fail(at,
                "found " + detail::quoted(text) + "; expected " + detail::kind_name(kind) + ", the result of " + detail::command_name(s));
  }
  const bool command = find_operator(text) != nullptr || detail::find_word(command_names, text);
  const bool digit = text.front() >= '0' && text.front() <= '9';
  // h07 or v3000000000 would read like a handle and be none.
  const bool like_handle = text.size() > 1 && std::string_view("hvfe").find(text[0]) != std::string_view::npos &&
                           text.find_first_not_of("0123456789", 1) == text.npos;
  if (command || digit || like_handle || text == "refused" || detail::find_word(function_names, text)) {
    return fail(at,
                "found " + detail::quoted(text) + "; expected a handle such as " + kind + "0, or a name that is no other word of scripts");
  }
  s.result.name = text;
  return true;
}

inline bool ScriptParser::expression(char kind, Expression& e) {
  skip();
  e.place = {number_, static_cast<std::uint32_t>(at_ + 1)};
  char wanted = kind;  // 'a' is a face or a vertex, the argument of anchor
  for (;;) {
    skip();
    const std::size_t begin = at_;
    const std::string_view text = word();
    const auto expected = [&] { return std::string("; expected ") + detail::kind_name(wanted); };
    const auto fits = [&](char letter) { return letter == wanted || (wanted == 'a' && (letter == 'f' || letter == 'v')); };
    if (const auto f = detail::find_word(function_names, text)) {
      const Function function = static_cast<Function>(*f);
      if (!take('(')) { return fail(at_, "found " + found() + "; expected '(' after " + std::string(text)); }
      if (!fits(detail::result_kind(function))) {
        return fail(begin, std::string(text) + " gives " + detail::kind_name(detail::result_kind(function)) + expected());
      }
      e.functions.push_back(function);
      wanted = function == Function::anchor ? 'a' : 'h';
      continue;
    }
    e.handle = detail::parse_handle(text);
    char letter = e.handle.letter;
    if (letter == 0) {
      const auto name = names_.find(text);
      if (name == names_.end()) {
        at_ = begin;
        return fail(begin, "found " + found() + expected() + ": a handle, or a name that is defined above");
      }
      e.name = text;
      letter = name->second;
    }
    if (!fits(letter)) { return fail(begin, detail::quoted(text) + " is " + detail::kind_name(letter) + expected()); }
    break;
  }
  for (std::size_t i = 0; i < e.functions.size(); ++i) {
    if (!take(')')) { return fail(at_, "found " + found() + "; expected ')'"); }
  }
  std::reverse(e.functions.begin(), e.functions.end());
  return true;
}

inline bool ScriptParser::raw(Statement& s) {
  skip();
  const std::size_t begin = at_;
  const auto field = detail::find_word(field_names, word());
  if (!field) {
    at_ = begin;
    return fail(begin, "found " + found() + "; expected a field: next, prev, vertex, face or anchor");
  }
  s.field = static_cast<Field>(*field);
  const char owner = s.field == Field::anchor ? 'a' : 'h';
  const char value = s.field == Field::vertex ? 'v' : s.field == Field::face ? 'f' : 'h';
  s.arguments.resize(2);
  if (!expression(owner, s.arguments[0]) || !expression(value, s.arguments[1])) { return false; }
  return at_end() || fail(at_, "found " + found() + "; expected the end of the line: raw has a field and two handles");
}

inline bool ScriptParser::number(long& value) {
  skip();
  const std::size_t begin = at_;
  const std::string_view text = word();
  value = 0;
  for (char c : text) {
    if (c < '0' || c > '9' || text.size() > 9) { break; }
    value = 10 * value + (c - '0');
  }
  if (!text.empty() && text.size() <= 9 && text.find_first_not_of("0123456789") == text.npos) { return true; }
  at_ = begin;
  return fail(begin, "found " + found() + "; expected a count");
}

inline bool ScriptParser::expect(Statement& s) {
  bool any = false;
  while (!at_end()) {
    const std::size_t begin = at_;
    const std::string_view text = word();
    const auto wrong = [&](const char* what) {
      at_ = begin;
      return fail(begin, "found " + found() + "; expected " + what);
    };
    if (text == "valid" && !any) {
      s.rules.emplace();
      return at_end() || fail(at_, "found " + found() + "; expected the end of the line");
    }
    if (text.size() == 2 && text[0] == 'R' && text[1] >= '1' && text[1] <= '8' && (!any || s.rules)) {
      if (!s.rules) { s.rules.emplace(); }
      if (std::find(s.rules->begin(), s.rules->end(), text[1] - '0') != s.rules->end()) { return wrong("each rule once"); }
      s.rules->push_back(text[1] - '0');
    } else if (text.size() == 1 && counted.find(text[0]) != counted.npos && !s.rules) {
      std::optional<long>& count = s.counts[counted.find(text[0])];
      if (count) { return wrong("each count once"); }
      long value = 0;
      if (!number(value)) { return false; }
      count = value;
    } else {
      return wrong(s.rules ? "a rule, R1 to R8"
                   : any   ? "one of v e f s h and a count"
                           : "counts (v 8 e 12 f 6 s 1 h 0), rules (R1 to R8), or valid");
    }
    any = true;
  }
  if (!any) { return fail(at_, "found the end of the line; expected counts (v 8 e 12 f 6 s 1 h 0), rules (R1 to R8), or valid"); }
  if (s.rules) { std::sort(s.rules->begin(), s.rules->end()); }
  return true;
}

// Reads a whole text.
[[nodiscard]] inline ScriptResult parse_script(std::string_view text) {
  ScriptParser parser;
  Script script;
  std::string comment;  // lines that wait for their statement
  const auto append = [](std::string& to, std::string_view line) {
    if (!to.empty()) { to += '\n'; }
    to += line;
  };
  std::uint32_t number = 1;
  bool head = true;  // only comments so far, no empty line
  if (text.substr(0, 3) == "\xef\xbb\xbf") { text.remove_prefix(3); }
  for (std::size_t begin = 0; begin < text.size() && parser.errors().size() < ScriptParser::max_errors; ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    std::optional<Statement> s = parser.parse_line(text.substr(begin, end - begin), number);
    if (s) {
      if (parser.comment()) { append(comment, *parser.comment()); }
      while (!comment.empty() && comment.back() == '\n') { comment.pop_back(); }
      s->caption = std::exchange(comment, {});
      script.statements.push_back(std::move(*s));
      head = false;
    } else if (parser.comment()) {
      append(comment, *parser.comment());
    } else if (!comment.empty()) {
      if (head) {
        const std::size_t cut = std::min(comment.find('\n'), comment.size());
        script.title = comment.substr(0, cut);
        script.introduction = comment.substr(std::min(cut + 1, comment.size()));
        comment.clear();
        head = false;
      } else if (comment.back() != '\n') {
        comment += '\n';  // an empty line parts paragraphs
      }
    }
    begin = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
  }
  while (!comment.empty() && comment.back() == '\n') { comment.pop_back(); }
  script.closing = std::move(comment);
  if (!parser.errors().empty()) { return {std::nullopt, parser.errors()}; }
  return {std::move(script), {}};
}

}  // namespace brep
