// SPDX-License-Identifier: MIT
#pragma once

// Writes JSON (RFC 8259), indented by two spaces, keys in the order of the calls.
//
//     JsonWriter json;
//     json.open_object();
//     json.key("rays").number(12);
//     json.key("surfaces").open_array(); ... json.close();
//     json.close();
//     const std::string text = json.text();
//
// The caller keeps the structure right: a key before every value in an object. Bytes that are not UTF-8, as names of files may hold, become
// U+FFFD. Numbers are written with the fewest digits that read back as the same double; NaN and infinities, which JSON lacks, become null.

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/utf8.hpp"

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
