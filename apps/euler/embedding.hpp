// SPDX-License-Identifier: MIT
#pragma once

// Draws a plane map in the unit disc without crossings, even with loops, spurs, parallel edges and faces of one edge.
//
// The map is refined to a simple triangulation: each edge gets inner points; each face gets a centre and a ring with one point for every
// point on its walk (so a face that passes an edge twice has two ring points there). The ring of the outer face is placed on a circle or
// regular polygon. In a triangulation with positive edge weights, placing each free point at the weighted mean of its neighbours gives a
// drawing without crossings (Tutte 1963; Floater 1997). Parts of it are very small, so the triangles are then brought close to given rest
// shapes: one point after another while some are tiny, finally all together (the symmetric Dirichlet energy, Smith and Schaefer 2015). No
// triangle turns over in the process, so no crossing appears.

#include <array>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "apps/euler/planar_map.hpp"

namespace apps::euler {

constexpr std::size_t inner_points = 3;  // per edge

struct Embedding {
  std::vector<glm::dvec2> vertices;                         // by index of PlanarMap::vertices
  std::vector<std::array<glm::dvec2, inner_points>> edges;  // from the start of dart 2i to that of dart 2i + 1
};

// y points up; the walk around an inner face is counter-clockwise. The corners of the outer face are equally spaced; the first corner of
// map.faces[outer] lies in the direction `first_corner` (radians). Nothing if parts are nested so deeply that doubles cannot represent
// the smallest.
[[nodiscard]] std::optional<Embedding> embed(const PlanarMap& map, std::uint32_t outer, double first_corner);

}  // namespace apps::euler
