// SPDX-License-Identifier: MIT
#pragma once

// A small strict JSON reader (RFC 8259) for tests: reference data and the program's own reports.
//
//     const json::Value data = json::parse_file(path);
//     const double area = data["patches"][3]["area"].number();
//
// Anything that is not what was asked for throws std::runtime_error with the place in the file or the path of
// keys that led there, so a test fails with a sentence. Numbers are doubles; a number written as a string
// ("0.19982489569838746", as the reference data do for more digits than a double holds) is also read by number().
// No comments, no trailing commas, no repeated key, nothing after the value; at most 500 levels.

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace json {

class Value {
 public:
  using Array = std::vector<Value>;
  using Member = std::pair<std::string, Value>;
  using Object = std::vector<Member>;  // in the order of the file
  using Data = std::variant<std::nullptr_t, bool, double, std::string, Array, Object>;

  Value() = default;
  explicit Value(Data data) : data_(std::move(data)) {}

  [[nodiscard]] bool is_null() const { return std::holds_alternative<std::nullptr_t>(data_); }
  [[nodiscard]] bool is_number() const { return std::holds_alternative<double>(data_); }
  [[nodiscard]] bool is_string() const { return std::holds_alternative<std::string>(data_); }
  [[nodiscard]] bool is_array() const { return std::holds_alternative<Array>(data_); }
  [[nodiscard]] bool is_object() const { return std::holds_alternative<Object>(data_); }

  [[nodiscard]] bool boolean() const { return get<bool>("true or false"); }
  [[nodiscard]] const std::string& string() const { return get<std::string>("a string"); }
  [[nodiscard]] const Array& array() const { return get<Array>("an array"); }
  [[nodiscard]] const Object& object() const { return get<Object>("an object"); }

  // A number, or a string that holds nothing but one.
  [[nodiscard]] double number() const {
    if (const auto* text = std::get_if<std::string>(&data_)) {
      double x = 0.0;
      const auto [end, code] = std::from_chars(text->data(), text->data() + text->size(), x);
      if (code == std::errc() && end == text->data() + text->size()) { return x; }
    }
    return get<double>("a number");
  }
  [[nodiscard]] std::vector<double> numbers() const {
    std::vector<double> result;
    for (const Value& item : array()) { result.push_back(item.number()); }
    return result;
  }

  // Elements of an array or members of an object.
  [[nodiscard]] std::size_t size() const { return is_object() ? object().size() : array().size(); }

  [[nodiscard]] const Value* find(std::string_view key) const {
    for (const Member& member : object()) {
      if (member.first == key) { return &member.second; }
    }
    return nullptr;
  }
  [[nodiscard]] bool contains(std::string_view key) const { return is_object() && find(key) != nullptr; }

  const Value& operator[](std::string_view key) const {
    if (const Value* found = find(key)) { return *found; }
    std::string known;
    for (const Member& member : object()) { known += (known.empty() ? "" : ", ") + member.first; }
    throw std::runtime_error("JSON: no key \"" + std::string(key) + "\"; the object has: " + known);
  }
  const Value& operator[](const char* key) const { return (*this)[std::string_view(key)]; }
  const Value& operator[](std::size_t index) const {
    if (index < array().size()) { return array()[index]; }
    throw std::runtime_error("JSON: no element " + std::to_string(index) + " in an array of " + std::to_string(array().size()));
  }
  const Value& operator[](int index) const { return (*this)[static_cast<std::size_t>(index)]; }

 private:
  template <class T>
  const T& get(const char* expected) const {
    if (const T* value = std::get_if<T>(&data_)) { return *value; }
    static constexpr const char* kinds[] = {"null", "true or false", "a number", "a string", "an array", "an object"};
    throw std::runtime_error(std::string("JSON: expected ") + expected + ", found " + kinds[data_.index()]);
  }

  Data data_ = nullptr;
};

namespace detail {

class Parser {
 public:
  Parser(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  Value whole() {
    Value result = value(0);
    skip_space();
    if (at_ != text_.size()) { fail("nothing more after the value"); }
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    std::size_t line = 1;
    std::size_t column = 1;
    for (std::size_t i = 0; i < at_ && i < text_.size(); ++i) {
      column = text_[i] == '\n' ? 1 : column + 1;
      line += text_[i] == '\n' ? 1 : 0;
    }
    const std::string found = at_ < text_.size() ? "'" + std::string(1, text_[at_]) + "'" : "the end";
    throw std::runtime_error(std::string(name_) + ":" + std::to_string(line) + ":" + std::to_string(column) + ": expected " + expected +
                             ", found " + found);
  }

  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_space() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) { ++at_; }
  }
  bool accept(char c) {
    skip_space();
    if (at_ >= text_.size() || text_[at_] != c) { return false; }
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) { fail(std::string{'\'', c, '\''}); }
  }
  bool accept_word(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) { return false; }
    at_ += word.size();
    return true;
  }

  Value value(int depth) {
    if (depth > 500) { fail("at most 500 levels"); }
    skip_space();
    if (peek() == '{') { return object(depth); }
    if (peek() == '[') { return array(depth); }
    if (peek() == '"') { return Value(string()); }
    if (accept_word("true")) { return Value(true); }
    if (accept_word("false")) { return Value(false); }
    if (accept_word("null")) { return Value(); }
    return Value(number());
  }

  Value object(int depth) {
    Value::Object members;
    expect('{');
    if (accept('}')) { return Value(std::move(members)); }
    do {
      skip_space();
      if (peek() != '"') { fail("a key in quotes"); }
      std::string key = string();
      for (const Value::Member& member : members) {
        if (member.first == key && members.size() < 1000) { fail("each key once, not \"" + key + "\" again"); }
      }
      expect(':');
      members.emplace_back(std::move(key), value(depth + 1));
    } while (accept(','));
    expect('}');
    return Value(std::move(members));
  }

  Value array(int depth) {
    Value::Array items;
    expect('[');
    if (accept(']')) { return Value(std::move(items)); }
    do { items.push_back(value(depth + 1)); } while (accept(','));
    expect(']');
    return Value(std::move(items));
  }

  // number = [-] int [frac] [exp]; from_chars would also take "01", ".5", "inf".
  double number() {
    const std::size_t begin = at_;
    const auto digits = [this] {
      const std::size_t first = at_;
      while (peek() >= '0' && peek() <= '9') { ++at_; }
      if (at_ == first) { fail(first == 0 || text_[first - 1] < '!' ? "a value" : "a digit"); }
      return at_ - first;
    };
    if (peek() == '-') { ++at_; }
    const bool zero = peek() == '0';
    if (digits() > 1 && zero) { fail("no leading zero"); }
    if (peek() == '.') {
      ++at_;
      digits();
    }
    if (peek() == 'e' || peek() == 'E') {
      ++at_;
      if (peek() == '+' || peek() == '-') { ++at_; }
      digits();
    }
    double x = 0.0;
    const auto [end, code] = std::from_chars(text_.data() + begin, text_.data() + at_, x);
    if (code != std::errc()) { fail("a number that a double can hold"); }
    return x;
  }

  std::string string() {
    std::string result;
    ++at_;
    while (true) {
      if (at_ >= text_.size() || static_cast<unsigned char>(text_[at_]) < 0x20) { fail("the closing quote"); }
      const char c = text_[at_++];
      if (c == '"') { return result; }
      if (c != '\\') {
        result += c;
        continue;
      }
      const char escape = peek();
      ++at_;
      static constexpr std::string_view from = "\"\\/bfnrt";
      static constexpr std::string_view to = "\"\\/\b\f\n\r\t";
      if (const std::size_t i = from.find(escape); i != std::string_view::npos) {
        result += to[i];
      } else if (escape == 'u') {
        append_utf8(result, code_point());
      } else {
        --at_;
        fail("an escape such as \\n or \\u0041");
      }
    }
  }

  std::uint32_t hex4() {
    std::uint32_t x = 0;
    const std::string_view digits = text_.substr(at_, 4);
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), x, 16);
    if (code != std::errc() || end != digits.data() + 4) { fail("four hexadecimal digits"); }
    at_ += 4;
    return x;
  }
  std::uint32_t code_point() {
    const std::uint32_t high = hex4();
    if (high < 0xd800 || high > 0xdfff) { return high; }
    if (high > 0xdbff || !accept_word("\\u")) { fail("a surrogate pair"); }
    const std::uint32_t low = hex4();
    if (low < 0xdc00 || low > 0xdfff) { fail("a surrogate pair"); }
    return 0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00);
  }
  static void append_utf8(std::string& out, std::uint32_t c) {
    const auto put = [&out](std::uint32_t byte) { out += static_cast<char>(static_cast<unsigned char>(byte)); };
    if (c < 0x80) {
      put(c);
      return;
    }
    if (c < 0x800) {
      put(0xc0 | (c >> 6));
    } else if (c < 0x10000) {
      put(0xe0 | (c >> 12));
      put(0x80 | ((c >> 6) & 0x3f));
    } else {
      put(0xf0 | (c >> 18));
      put(0x80 | ((c >> 12) & 0x3f));
      put(0x80 | ((c >> 6) & 0x3f));
    }
    put(0x80 | (c & 0x3f));
  }

  std::string_view text_;
  std::string_view name_;
  std::size_t at_ = 0;
};

}  // namespace detail

// `name` stands before line:column in the message of a failure.
[[nodiscard]] inline Value parse(std::string_view text, std::string_view name = "JSON") { return detail::Parser(text, name).whole(); }

[[nodiscard]] inline Value parse_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) { throw std::runtime_error("cannot open " + path); }
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return parse(text, path);
}

}  // namespace json
