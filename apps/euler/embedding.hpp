// SPDX-License-Identifier: MIT
#pragma once

// A plane map drawn in the unit disc without crossings, whatever its loops, spurs, parallel edges and faces of one edge.
//
// The map is made a simple triangulation: each edge gets inner points, each face a ring of one point for every point that its walk
// passes (so a face that passes an edge twice has two ring points there) and a centre. The ring of the outer face stands on a
// circle or regular polygon. With positive weights on the edges of a triangulation, placing each free point at the weighted mean
// of its neighbours gives a drawing without crossings (Tutte 1963; Floater 1997). It is cramped, so triangles are then brought near to
// a shape of their own: one point after another while some are tiny, all together at last (the symmetric Dirichlet energy,
// Smith and Schaefer 2015). No triangle turns over on the way, hence no crossing appears.

#include <array>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "apps/euler/planar_map.hpp"

namespace apps::euler {

constexpr std::size_t inner_points = 3;  // of an edge

struct Embedding {
  std::vector<glm::dvec2> vertices;                         // by index of PlanarMap::vertices
  std::vector<std::array<glm::dvec2, inner_points>> edges;  // from the start of dart 2i to that of dart 2i + 1
};

// y points up; the walk around an inner face is counter-clockwise. The corners of the outer face are spread evenly; the first
// corner of map.faces[outer] lies in the direction `first_corner` (radians). Nothing when parts lie within one another so deeply that
// doubles cannot hold the smallest.
[[nodiscard]] std::optional<Embedding> embed(const PlanarMap& map, std::uint32_t outer, double first_corner);

}  // namespace apps::euler
