// SPDX-License-Identifier: MIT
#pragma once

// The picture of all shells in one state: curves, and positions for the labels. svg.cpp draws it.
//
// Each shell has a panel of its own, a square from (-1, -1) to (1, 1), y up, that its drawing fills. A picture is made similar to the one
// before it: the outer face remains the same while it exists, whole edges remain whole, and of the rotations by whole corners the one is
// chosen that moves the vertices least.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "apps/euler/embedding.hpp"

namespace apps::euler {

// A curve along a polyline whose corners are rounded by parabolas: with rounding 1 a smooth curve (quadratic B-spline), with 0 the
// polyline itself.
struct Curve {
  std::array<glm::dvec2, inner_points + 2> points{};
  double rounding = 1.0;

  // The parabola at inner point k: from arc(k)[0] to arc(k)[2] with control point arc(k)[1]. Straight segments connect the parabolas.
  [[nodiscard]] std::array<glm::dvec2, 3> arc(std::size_t k) const;

  // A polyline that approximates it, with `pieces` segments per arc.
  [[nodiscard]] std::vector<glm::dvec2> flat(int pieces) const;
};

// A point on a polyline, and the direction of the line there.
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
  std::array<glm::dvec2, 2> names{};  // positions of the names of the half-edge and its twin
  std::array<double, 2> sizes{};      // the size of their letters; 0: not drawn
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
struct FaceArea {  // an inner face of a shell drawn without stubs, or an area bounded by one face only
  std::uint32_t face = 0;
  std::vector<std::size_t> strands;  // around it; the bitwise complement of the index for a strand passed backwards
};

struct Panel {
  std::vector<Strand> strands;  // empty if the shell is nested too deeply to be drawn
  std::vector<VertexMark> vertices;
  std::vector<FaceLabel> labels;
  std::vector<FaceArea> areas;
  std::uint32_t outer_face = 0;  // the face around the drawing, or the one with the largest part of the area around it
  bool outer_whole = true;       // is it the only face there?
  double text = 0.06;            // suitable size of letters
  double gap = 0.02;             // distance from an edge to its half-edges
};

struct Layout {
  std::vector<Panel> panels;  // one per shell, in the order of their first half-edges
};

// The number of columns in which the panels are arranged.
[[nodiscard]] std::size_t columns_of(const Layout& layout);

// `before`: the picture of the state before, or empty. `smallest`: the smallest size of letters worth drawing, in a panel that fills the
// whole picture.
[[nodiscard]] Layout lay_out(const Records& records, const Layout& before, double smallest);

// --- names
//
// The room of a face is the radius of the largest circle in it; in small rooms the letters are small. Names of half-edges are placed
// beside the middle of their edge or, if another name is there, elsewhere along it. Names never overlap; one without room is not drawn
// (size 0). Names of faces are placed at the largest distance from all lines, vertices and other names.

// The area of a name in the panel: its centre, and half its width and height. In DejaVu Sans Bold, a digit is .7 of the size wide and .73
// high; other fonts are narrower. A vertex is a disk; both halves are its radius.
struct NameBox {
  glm::dvec2 at{0.0}, half{0.0};
  bool disk = false;
};
[[nodiscard]] inline NameBox name_box(const glm::dvec2& at, std::size_t letters, double size) {
  return {at, {0.35 * static_cast<double>(letters) * size, 0.38 * size}};
}
constexpr double vertex_radius = 0.92;  // relative to the size of the text
[[nodiscard]] inline NameBox vertex_box(const Panel& panel, const VertexMark& v) {
  return {v.at, glm::dvec2{(vertex_radius + 0.08) * panel.text}, true};  // including its outline
}
[[nodiscard]] inline bool cover(const NameBox& a, const NameBox& b) {
  if (a.half.y == 0.0 || b.half.y == 0.0) { return false; }  // not drawn
  const glm::dvec2 apart = glm::abs(a.at - b.at);
  if (a.disk == b.disk) { return apart.x < a.half.x + b.half.x && apart.y < a.half.y + b.half.y; }
  const NameBox &disk = a.disk ? a : b, &box = a.disk ? b : a;
  return glm::length(glm::max(apart - box.half, glm::dvec2{0.0})) < disk.half.x;
}

// Requires the strands, vertices and areas of the panel; fills in the rest. `smallest`: smallest size of letters.
void place_names(const PlanarMap& map, std::uint32_t outer, double smallest, Panel& panel);

}  // namespace apps::euler
