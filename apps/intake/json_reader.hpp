// SPDX-License-Identifier: MIT
#pragma once

// Reads JSON (RFC 8259) into a tree of values. Strings are UTF-8; errors have their position. At most 64 levels deep, so recursion is
// bounded. Asking a value for another type gives nothing (or the default), so readers need no checks of their own.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace apps {

class JsonValue {
 public:
  enum class Kind : unsigned char { null, boolean, number, string, array, object };

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] std::size_t offset() const { return offset_; }  // bytes before it in the text

  // The member of an object, or the item of an array; a null value if it does not exist.
  [[nodiscard]] const JsonValue& operator[](std::string_view key) const;
  [[nodiscard]] const JsonValue& operator[](std::size_t index) const;
  [[nodiscard]] const std::vector<JsonValue>& items() const { return items_; }  // of arrays and objects
  [[nodiscard]] const std::vector<std::string>& keys() const { return keys_; }  // of objects, one for each item
  [[nodiscard]] explicit operator bool() const { return kind_ != Kind::null; }

  [[nodiscard]] double number(double otherwise = 0.0) const { return kind_ == Kind::number ? number_ : otherwise; }
  [[nodiscard]] bool boolean(bool otherwise = false) const { return kind_ == Kind::boolean ? number_ != 0.0 : otherwise; }
  [[nodiscard]] const std::string& string() const { return text_; }  // empty unless it is a string
  // A whole number from 0 on; nothing for any other value.
  [[nodiscard]] std::optional<std::size_t> index() const;

 private:
  friend class JsonParser;
  Kind kind_ = Kind::null;
  double number_ = 0.0;
  std::size_t offset_ = 0;
  std::string text_;
  std::vector<std::string> keys_;  // of an object, in the order of items_
  std::vector<JsonValue> items_;
};

struct JsonFault {
  std::size_t offset = 0;
  std::string sentence;
};

// The value of the text; after an error nothing, and `fault` is set.
[[nodiscard]] std::optional<JsonValue> parse_json(std::string_view text, JsonFault& fault);

}  // namespace apps
