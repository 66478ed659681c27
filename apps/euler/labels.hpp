// SPDX-License-Identifier: MIT
#pragma once

// Places and sizes for the names in a panel.
//
// The room of a face is the radius of the largest circle in it; letters are small where there is little. Names of half-edges stand
// beside the middle of their edge or, where another name is, elsewhere along it; no name covers another, and one that finds no room is not
// drawn (size 0). Names of faces stand where the way to all lines, vertices and other names is longest.

#include <cmath>
#include <cstddef>

#include <glm/vec2.hpp>

#include "apps/euler/layout.hpp"

namespace apps::euler {

// What a name takes of the panel: its middle, and half its width and height. In DejaVu Sans, bold, a digit is .7 of the size wide and .73
// high; other fonts are narrower.
struct NameBox {
  glm::dvec2 at{0.0}, half{0.0};
};
[[nodiscard]] inline NameBox name_box(const glm::dvec2& at, std::size_t letters, double size) {
  return {at, {0.35 * static_cast<double>(letters) * size, 0.38 * size}};
}
[[nodiscard]] inline NameBox vertex_box(const Panel& panel, const VertexMark& v) { return {v.at, glm::dvec2{0.75 * panel.text}}; }
[[nodiscard]] inline bool cover(const NameBox& a, const NameBox& b) {
  if (a.half.y == 0.0 || b.half.y == 0.0) { return false; }  // not drawn
  return std::abs(a.at.x - b.at.x) < a.half.x + b.half.x && std::abs(a.at.y - b.at.y) < a.half.y + b.half.y;
}

// Needs the strands, vertices and areas of the panel; fills in the rest. `smallest` is the least size of letters.
void place_names(const PlanarMap& map, std::uint32_t outer, double smallest, Panel& panel);

}  // namespace apps::euler
