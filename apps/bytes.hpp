// SPDX-License-Identifier: MIT
#pragma once

// Numbers as bytes of a file, bytes as text of a page, a checksum, and the header of a PLY file.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

namespace apps {

// The bytes of a number, the lowest first.
template <class Number>
void put(std::string& out, Number value) {
  static_assert(std::is_arithmetic_v<Number> && std::numeric_limits<double>::is_iec559);
  const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  std::endian::native == std::endian::little ? out.append(bytes.begin(), bytes.end()) : out.append(bytes.rbegin(), bytes.rend());
}
template <glm::length_t n, class Number>
void put(std::string& out, const glm::vec<n, Number>& vector) {
  for (glm::length_t k = 0; k < n; ++k) { put(out, vector[k]); }
}

// The bits of the number of `size` bytes at position `at`; the caller must have checked that the bytes exist.
[[nodiscard]] inline std::uint64_t bits_at(std::string_view bytes, std::size_t at, std::size_t size, bool big_endian = false) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << 8 * (big_endian ? size - 1 - i : i);
  }
  return bits;
}

// Base64 as in RFC 4648.
inline constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

[[nodiscard]] inline std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U; };
    const unsigned bits = (byte(0) << 16U) | (byte(1) << 8U) | byte(2);
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? base64_digits[(bits >> (18U - 6U * static_cast<unsigned>(k))) & 63U] : '=';
    }
  }
  return text;
}

// Nothing if the text has other characters. Signs '=' at the end need not be there.
[[nodiscard]] inline std::optional<std::string> from_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  unsigned count = 0;
  while (!text.empty() && text.back() == '=') { text.remove_suffix(1); }
  for (const char c : text) {
    const std::size_t value = base64_digits.find(c);
    if (value == base64_digits.npos) { return std::nullopt; }
    bits = bits << 6U | static_cast<std::uint32_t>(value);
    if ((count += 6) < 8) { continue; }
    count -= 8;
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> count & 0xffU));
  }
  return bytes;
}

// CRC of ISO 3309, as in PNG and gzip.
[[nodiscard]] inline std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = ~0U;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) { crc = (crc >> 1U) ^ (0xedb88320U & (0U - (crc & 1U))); }
  }
  return ~crc;
}

// 64-bit FNV-1a (Fowler, Noll and Vo 1991): detects accidental damage of files, not manipulation.
class Checksum {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) { state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull; }
  }
  void add(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) { state_ = (state_ ^ (number >> shift & 0xff)) * 0x100000001b3ull; }
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

  // Sixteen hexadecimal digits.
  [[nodiscard]] std::string text() const {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) { digits += hex[state_ >> shift & 15]; }
    return digits;
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ull;
};

[[nodiscard]] inline std::string checksum_of(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.text();
}

// The header of a binary, little-endian PLY file (Turk 1994). The numbers of the elements follow it.
struct PlyElement {
  std::string_view name;
  std::size_t count;
  std::vector<std::string_view> properties;  // each as "float x"
};

[[nodiscard]] inline std::string ply_header(const std::vector<std::string>& comments, const std::vector<PlyElement>& elements) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : comments) { text += "comment " + comment + "\n"; }
  for (const PlyElement& element : elements) {
    text.append("element ").append(element.name).append(" ").append(std::to_string(element.count)).append("\n");
    for (const std::string_view property : element.properties) { text.append("property ").append(property).append("\n"); }
  }
  return text + "end_header\n";
}

}  // namespace apps
