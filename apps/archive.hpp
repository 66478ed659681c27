// SPDX-License-Identifier: MIT
#pragma once

// Converts values to bytes and back. For every type there is one list of fields, which both directions use:
//
//     struct Fields {
//       template <class Archive, class T>
//       void operator()(Archive& a, T& x) const { a(x.name, x.area); }    // with if constexpr for several types
//     };
//
// Little-endian, without gaps: numbers as in memory, booleans as one byte, texts and lists preceded by their length (uint64), optionals
// preceded by a byte that says whether there is a value. An optional enumeration is one byte, 0 for none.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

#include "apps/bytes.hpp"

namespace apps {

template <class Fields>
class ArchiveWriter {
 public:
  std::string bytes;

  void operator()(const auto&... values) { (write(values), ...); }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      put(bytes, static_cast<std::uint8_t>(value));
    } else if constexpr (std::is_arithmetic_v<T>) {
      put(bytes, value);
    } else {
      Fields{}(*this, value);
    }
  }
  template <glm::length_t n, class Number>
  void write(const glm::vec<n, Number>& vector) {
    put(bytes, vector);
  }
  void write(const std::string& text) {
    put(bytes, std::uint64_t{text.size()});
    bytes += text;
  }
  template <class Item>
  void write(const std::vector<Item>& list) {
    put(bytes, std::uint64_t{list.size()});
    for (const Item& item : list) { write(item); }
  }
  template <class T>
  void write(const std::optional<T>& value) {
    if constexpr (std::is_enum_v<T>) {
      put(bytes, static_cast<std::uint8_t>(value ? 1 + static_cast<int>(*value) : 0));
    } else {
      write(value.has_value());
      if (value) { write(*value); }
    }
  }
};

// If the bytes end too early, the remaining values are left unchanged and sound() is false from then on.
template <class Fields>
class ArchiveReader {
 public:
  explicit ArchiveReader(std::string_view bytes) : rest_{bytes} {}

  void operator()(auto&... values) { (read(values), ...); }
  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in memory");

  std::string_view take(std::uint64_t size) {
    sound_ = sound_ && size <= rest_.size();
    const std::string_view taken = rest_.substr(0, sound_ ? size : 0);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  template <class T>
  void read(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      read(byte);
      value = byte != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      const std::string_view taken = take(sizeof(T));
      std::memcpy(&value, taken.data(), taken.size());
    } else {
      Fields{}(*this, value);
    }
  }
  template <glm::length_t n, class Number>
  void read(glm::vec<n, Number>& vector) {
    for (glm::length_t k = 0; k < n; ++k) { read(vector[k]); }
  }
  void read(std::string& text) {
    std::uint64_t size = 0;
    read(size);
    text = take(size);
  }
  template <class Item>
  void read(std::vector<Item>& list) {
    std::uint64_t count = 0;
    read(count);
    list.clear();
    for (; count > 0 && sound_; --count) { read(list.emplace_back()); }  // stops when the bytes end
  }
  template <class T>
  void read(std::optional<T>& value) {
    std::uint8_t byte = 0;
    read(byte);
    if constexpr (std::is_enum_v<T>) {
      if (byte > 0) { value = static_cast<T>(byte - 1); }
    } else if (byte > 0) {
      read(value.emplace());
    }
  }

  std::string_view rest_;
  bool sound_ = true;
};

}  // namespace apps
