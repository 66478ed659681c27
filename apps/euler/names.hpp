// SPDX-License-Identifier: MIT
#pragma once

// Places and sizes for the names in a panel.
//
// The room of a face is the radius of the largest circle in it; letters are small where there is little. Names of half-edges stand
// beside the middle of their edge or, where another name is, elsewhere along it; no name covers another, and one that finds no room is not
// drawn (size 0). Names of faces stand where the way to all lines, vertices and other names is longest.

#include <cstddef>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "apps/euler/layout.hpp"

namespace apps::euler {

// What a name takes of the panel: its middle, and half its width and height. In DejaVu Sans, bold, a digit is .7 of the size wide and .73
// high; other fonts are narrower. A vertex is a disk, whose radius is both halves.
struct NameBox {
  glm::dvec2 at{0.0}, half{0.0};
  bool disk = false;
};
[[nodiscard]] inline NameBox name_box(const glm::dvec2& at, std::size_t letters, double size) {
  return {at, {0.35 * static_cast<double>(letters) * size, 0.38 * size}};
}
constexpr double vertex_radius = 0.92;  // of the size of the text
[[nodiscard]] inline NameBox vertex_box(const Panel& panel, const VertexMark& v) {
  return {v.at, glm::dvec2{(vertex_radius + 0.08) * panel.text}, true};  // with its line
}
[[nodiscard]] inline bool cover(const NameBox& a, const NameBox& b) {
  if (a.half.y == 0.0 || b.half.y == 0.0) { return false; }  // not drawn
  const glm::dvec2 apart = glm::abs(a.at - b.at);
  if (a.disk == b.disk) { return apart.x < a.half.x + b.half.x && apart.y < a.half.y + b.half.y; }
  const NameBox &disk = a.disk ? a : b, &box = a.disk ? b : a;
  return glm::length(glm::max(apart - box.half, glm::dvec2{0.0})) < disk.half.x;
}

// Needs the strands, vertices and areas of the panel; fills in the rest. `smallest` is the least size of letters.
void place_names(const PlanarMap& map, std::uint32_t outer, double smallest, Panel& panel);

}  // namespace apps::euler
