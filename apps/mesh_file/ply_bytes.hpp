// SPDX-License-Identifier: MIT
#pragma once

// Writing PLY (Turk 1994), binary and little-endian: its header. What follows it are bytes of numbers (bytes.hpp).

#include <string>
#include <string_view>
#include <vector>

#include "apps/bytes.hpp"

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

}  // namespace apps
