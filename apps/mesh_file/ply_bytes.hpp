// SPDX-License-Identifier: MIT
#pragma once

// Writing PLY (Turk 1994), binary and little-endian: its header, and the bytes of its values.

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace apps {

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

// The bytes of a number, the lowest first.
template <class Number>
void put(std::string& out, Number value) {
  static_assert(std::is_arithmetic_v<Number> && std::numeric_limits<double>::is_iec559);
  const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  std::endian::native == std::endian::little ? out.append(bytes.begin(), bytes.end()) : out.append(bytes.rbegin(), bytes.rend());
}

}  // namespace apps
