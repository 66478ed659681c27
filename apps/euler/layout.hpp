// SPDX-License-Identifier: MIT
#pragma once

// The picture of all shells at one moment: curves, and places for the labels; what svg.cpp draws.
//
// Each shell has a panel of its own, a square from (-1, -1) to (1, 1), y up, that its drawing fills. A picture is made to look like
// the one before it: the face that lay outside stays outside while it lives, edges that were
// whole stay whole, and of the ways to turn the picture by one corner the one is taken that moves the vertices least.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "apps/euler/embedding.hpp"

namespace apps::euler {

// A curve along a line of points, its corners rounded by parabolas: a smooth one (quadratic B-spline) with rounding 1, the line itself with
// 0.
struct Curve {
  std::array<glm::dvec2, inner_points + 2> points{};
  double rounding = 1.0;

  // The parabola at inner point k: from arc(k)[0] to arc(k)[2] with the control point arc(k)[1]. Straight lines lie between.
  [[nodiscard]] std::array<glm::dvec2, 3> arc(std::size_t k) const;

  // Straight pieces that follow it, `pieces` for each arc.
  [[nodiscard]] std::vector<glm::dvec2> flat(int pieces) const;
};

// A place on a line of straight pieces, and where the line runs there.
struct Spot {
  glm::dvec2 at{0.0}, along{1.0, 0.0};

  [[nodiscard]] glm::dvec2 left() const { return {-along.y, along.x}; }
};
[[nodiscard]] double length_of(const std::vector<glm::dvec2>& line);
[[nodiscard]] Spot spot_on(const std::vector<glm::dvec2>& line, double way);

struct Strand {                // an edge, or one of the two stubs of an edge that is cut open
  std::uint32_t halfedge = 0;  // leaves the start of the curve; for a stub, the vertex
  bool stub = false;
  Curve curve;
  std::array<glm::dvec2, 2> names{};  // where the names of the half-edge and of its twin stand
  std::array<double, 2> sizes{};      // and the size of their letters
};
struct VertexMark {
  std::uint32_t vertex = 0;
  glm::dvec2 at{0.0};
};
struct FaceLabel {
  std::uint32_t face = 0;
  glm::dvec2 at{0.0};
  double size = 0.0;
};
struct FaceArea {  // an inner face of a shell that is drawn whole, or where all that bounds the area is one face
  std::uint32_t face = 0;
  std::vector<std::size_t> strands;  // around it; the bitwise complement of the index where the strand is passed backwards
};

struct Panel {
  std::vector<Strand> strands;  // none when the shell is nested too deeply to be drawn
  std::vector<VertexMark> vertices;
  std::vector<FaceLabel> labels;
  std::vector<FaceArea> areas;
  std::uint32_t outer_face = 0;  // the face around the drawing, or the one with most of what lies there
  bool outer_whole = true;       // it is the only one
  double text = 0.06;            // a good size for letters
  double gap = 0.02;             // from an edge to its half-edges
};

struct Layout {
  std::vector<Panel> panels;  // one for each shell, in the order of their first half-edges
};

// Panels are put side by side in this number of columns.
[[nodiscard]] std::size_t columns_of(const Layout& layout);

// `before` is the picture of the state before, or empty. `smallest` is the least size of letters that is worth drawing, in a panel
// that has the picture for itself.
[[nodiscard]] Layout lay_out(const Records& records, const Layout& before, double smallest);

// --- names
//
// The room of a face is the radius of the largest circle in it; letters are small where there is little. Names of half-edges stand
// beside the middle of their edge or, where another name is, elsewhere along it; no name covers another, and one that finds no room is not
// drawn (size 0). Names of faces stand where the way to all lines, vertices and other names is longest.

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
