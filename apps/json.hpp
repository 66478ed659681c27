// SPDX-License-Identifier: MIT
#pragma once

// Writes JSON (RFC 8259), indented by two spaces, with keys in the order of the calls.
//
//     JsonWriter json;
//     json.open_object();
//     json.fields("rays", rays, "area", area);
//     json.key("surfaces").list(surfaces, [&](const Surface& s) { json.object("name", s.name, "area", s.area); });
//     json.close();
//     const std::string text = json.text();
//
// The caller must keep the structure valid: a key before every value in an object. Bytes that are not UTF-8 (file names may contain them)
// become U+FFFD. Numbers are written with the fewest digits that read back as the same double; NaN and infinities, which JSON lacks,
// become null.

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "apps/text.hpp"

namespace apps {

class JsonWriter {
 public:
  JsonWriter& key(std::string_view name) {
    separate();
    quote(name);
    text_ += ": ";
    after_key_ = true;
    return *this;
  }
  JsonWriter& open_object() { return open('{', '}'); }
  JsonWriter& open_array() { return open('[', ']'); }
  JsonWriter& close() {
    const Level level = levels_.back();
    levels_.pop_back();
    if (!level.empty) { new_line(); }
    text_ += level.bracket;
    if (levels_.empty()) { text_ += '\n'; }
    return *this;
  }

  JsonWriter& number(double value) {
    if (!std::isfinite(value)) { return null(); }
    return characters(value);
  }
  JsonWriter& count(std::uint64_t value) { return characters(value); }
  JsonWriter& boolean(bool value) { return raw(value ? "true" : "false"); }
  JsonWriter& null() { return raw("null"); }
  JsonWriter& string(std::string_view value) {
    separate();
    quote(value);
    return *this;
  }

  // Writes a value according to its type: boolean, count, number, text, the content of an optional or null, a list of these, a vector of
  // three, or whatever a function writes.
  template <class Value>
  JsonWriter& value(const Value& value) {
    if constexpr (std::is_same_v<Value, bool>) {
      boolean(value);
    } else if constexpr (std::is_integral_v<Value>) {
      characters(value);
    } else if constexpr (std::is_floating_point_v<Value>) {
      number(value);
    } else if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
      string(value);
    } else if constexpr (std::is_invocable_v<const Value&, JsonWriter&>) {
      value(*this);
    } else if constexpr (requires { value.x + value.y + value.z; }) {
      this->value(std::array{static_cast<double>(value.x), static_cast<double>(value.y), static_cast<double>(value.z)});
    } else if constexpr (requires { value.has_value(); }) {
      value.has_value() ? this->value(*value) : null();
    } else {
      list(value, [this](const auto& item) { this->value(item); });
    }
    return *this;
  }
  // An array whose elements `write` writes.
  template <class List, class Write>
  JsonWriter& list(const List& items, const Write& write) {
    open_array();
    for (const auto& item : items) { write(item); }
    return close();
  }
  // fields("name", name, "area", area) writes keys with their values; object() also encloses them in braces.
  JsonWriter& fields() { return *this; }
  template <class Value, class... Rest>
  JsonWriter& fields(std::string_view name, const Value& its_value, const Rest&... rest) {
    key(name).value(its_value);
    return fields(rest...);
  }
  template <class... Pairs>
  JsonWriter& object(const Pairs&... pairs) {
    return open_object().fields(pairs...).close();
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  struct Level {
    char bracket;
    bool empty;
  };

  template <class Number>
  JsonWriter& characters(Number value) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return raw({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }
  JsonWriter& raw(std::string_view text) {
    separate();
    text_ += text;
    return *this;
  }
  JsonWriter& open(char bracket, char closing) {
    separate();
    text_ += bracket;
    levels_.push_back({closing, true});
    return *this;
  }
  void new_line() {
    text_ += '\n';
    text_.append(2 * levels_.size(), ' ');
  }
  void separate() {
    if (after_key_) {
      after_key_ = false;
      return;
    }
    if (levels_.empty()) { return; }
    if (!levels_.back().empty) { text_ += ','; }
    levels_.back().empty = false;
    new_line();
  }
  void quote(std::string_view value) {
    text_ += '"';
    for (const char c : to_utf8(value)) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') { text_ += '\\'; }
      if (byte >= 0x20) {
        text_ += c;
        continue;
      }
      constexpr std::string_view hex = "0123456789abcdef";
      text_ += "\\u00";
      text_ += hex[byte >> 4];
      text_ += hex[byte & 15];
    }
    text_ += '"';
  }

  std::string text_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

}  // namespace apps
