// SPDX-License-Identifier: MIT
#include "apps/intake/json_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <tuple>

#include "apps/mesh_file/reading.hpp"
#include "apps/text.hpp"

namespace apps {

class JsonParser {
 public:
  JsonParser(std::string_view text, JsonFault& fault) : text_(text), fault_(fault) {}

  std::optional<JsonValue> run() {
    at_ = text_.size() - without_mark(text_).size();
    JsonValue value;
    if (!read(value, 0)) { return std::nullopt; }
    skip();
    if (at_ == text_.size()) { return value; }
    fail("expected the end of the file, found " + here());
    return std::nullopt;
  }

 private:
  static constexpr std::size_t deepest = 64, most_values = 5'000'000;  // a value takes about a hundred bytes, a digit in the text just one

  void skip() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) { ++at_; }
  }
  bool fail(std::string sentence) {
    fault_ = {at_, std::move(sentence)};
    return false;
  }
  [[nodiscard]] std::string here() const {
    return at_ < text_.size() ? mesh_file::shown(text_.substr(at_, 12)) : std::string("the end of the file");
  }
  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) { return false; }
    ++at_;
    return true;
  }

  bool read(JsonValue& out, std::size_t depth) {
    skip();
    out.offset_ = at_;
    if (++values_ > most_values) { return fail("the text has more than " + std::to_string(most_values) + " values"); }
    if (depth > deepest) { return fail("values are nested deeper than " + std::to_string(deepest)); }
    if (at_ >= text_.size()) { return fail("expected a value, found the end of the file"); }
    using Kind = JsonValue::Kind;
    switch (text_[at_]) {
      case '{':
        out.kind_ = Kind::object;
        return list(out, '}', depth);
      case '[':
        out.kind_ = Kind::array;
        return list(out, ']', depth);
      case '"':
        out.kind_ = Kind::string;
        return string(out.text_);
      default:
        break;
    }
    for (const auto& [word, kind, value] :
         {std::tuple("true", Kind::boolean, 1.0), {"false", Kind::boolean, 0.0}, {"null", Kind::null, 0.0}}) {
      const std::string_view name = word;
      if (text_.substr(at_, name.size()) != name) { continue; }
      at_ += name.size();
      out.kind_ = kind;
      out.number_ = value;
      return true;
    }
    const char* const begin = text_.data() + at_;
    const auto [end, code] = std::from_chars(begin, text_.data() + text_.size(), out.number_);
    if (end == begin || std::string_view("-0123456789").find(*begin) == std::string_view::npos) {
      return fail("expected a value, found " + here());
    }
    if (code != std::errc() || !std::isfinite(out.number_)) { return fail("the number " + here() + " is beyond what a number can hold"); }
    out.kind_ = Kind::number;
    at_ += static_cast<std::size_t>(end - begin);
    return true;
  }

  // Parses the items of an array or the members of an object.
  bool list(JsonValue& out, char closing, std::size_t depth) {
    ++at_;
    if (take(closing)) { return true; }
    do {
      if (closing == '}') {
        skip();
        out.keys_.emplace_back();
        if (at_ >= text_.size() || text_[at_] != '"') { return fail("expected a key in quotes, found " + here()); }
        if (!string(out.keys_.back())) { return false; }
        if (!take(':')) { return fail("expected ':' after a key, found " + here()); }
      }
      out.items_.emplace_back();
      if (!read(out.items_.back(), depth + 1)) { return false; }
    } while (take(','));
    return take(closing) || fail(std::string("expected ',' or '") + closing + "', found " + here());
  }

  bool string(std::string& out) {
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (static_cast<unsigned char>(text_[at_]) < 0x20) { return fail("a string is not closed on its line"); }
      if (text_[at_] != '\\') {
        out += text_[at_];
        continue;
      }
      if (++at_ >= text_.size()) { break; }
      constexpr std::string_view names = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
      const std::size_t which = names.find(text_[at_]);
      if (which != std::string_view::npos) {
        out += meanings[which];
      } else if (text_[at_] != 'u' || !character(out)) {
        return fail("a string has a mark '\\' that means nothing");
      }
    }
    if (at_ >= text_.size()) { return fail("a string is not closed"); }
    ++at_;
    return true;
  }
  // Parses the four digits after \u and appends them as UTF-8; surrogate pairs are combined.
  bool character(std::string& out) {
    const auto four = [&](std::size_t from, std::uint32_t& value) {
      const std::string_view digits = text_.substr(std::min(from, text_.size()), 4);
      const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
      return digits.size() == 4 && code == std::errc() && end == digits.data() + 4;
    };
    std::uint32_t code = 0, low = 0;
    if (!four(at_ + 1, code)) { return false; }
    at_ += 4;
    if (code >= 0xd800 && code < 0xdc00 && text_.substr(at_ + 1, 2) == "\\u" && four(at_ + 3, low) && low >= 0xdc00 && low < 0xe000) {
      code = 0x10000 + ((code - 0xd800) << 10U) + (low - 0xdc00);
      at_ += 6;
    }
    const auto put = [&](std::uint32_t bits) { out += static_cast<char>(static_cast<unsigned char>(bits)); };
    if (code < 0x80) {
      put(code);
    } else if (code < 0x800) {
      put(0xc0 | code >> 6U), put(0x80 | (code & 0x3fU));
    } else if (code < 0x10000) {
      put(0xe0 | code >> 12U), put(0x80 | (code >> 6U & 0x3fU)), put(0x80 | (code & 0x3fU));
    } else {
      put(0xf0 | code >> 18U), put(0x80 | (code >> 12U & 0x3fU)), put(0x80 | (code >> 6U & 0x3fU)), put(0x80 | (code & 0x3fU));
    }
    return true;
  }

  std::string_view text_;
  JsonFault& fault_;
  std::size_t at_ = 0, values_ = 0;
};

namespace {
const JsonValue nothing;
}

const JsonValue& JsonValue::operator[](std::string_view key) const {
  const auto found = std::find(keys_.begin(), keys_.end(), key);
  return found == keys_.end() ? nothing : items_[static_cast<std::size_t>(found - keys_.begin())];
}

const JsonValue& JsonValue::operator[](std::size_t index) const {
  return kind_ == Kind::array && index < items_.size() ? items_[index] : nothing;
}

std::optional<std::size_t> JsonValue::index() const {
  if (kind_ != Kind::number || !(number_ >= 0.0) || number_ != std::floor(number_) || number_ > 4e9) { return std::nullopt; }
  return static_cast<std::size_t>(number_);
}

std::optional<JsonValue> parse_json(std::string_view text, JsonFault& fault) { return JsonParser(text, fault).run(); }

}  // namespace apps
