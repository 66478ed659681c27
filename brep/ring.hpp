// SPDX-License-Identifier: MIT
#pragma once

// A face of many corners, such as the cap of a cylinder, cut into a ring of faces around an inner one of half as many corners.
//
// Regular refinement (refine.hpp) makes n wedges around the centre of a face of n corners, and a wedge stays thin however often it is
// refined. Here two edges of the face make one cell, about as deep as it is wide, and what is left in the middle has ceil(n / 2)
// corners; it can be cut so again, until regular refinement does well.
//
//         *-----*                *-----*
//       /         \            /  \   /  \       every second corner is joined to the inner corner on its way to the centroid;
//      *           *          *    *-*    *      cells have five corners, two of the face and one between them, two of the inner face
//      |     f     |   ==>    |    |f|    |      (of an odd face the last cell has four);
//      *           *          *    *-*    *      all keep the level of f, so nothing changes for its neighbours, and T-vertices
//       \         /            \  /   \  /       on its edges stay what they are.
//         *-----*                *-----*
//
// The inner face is the polygon of every second corner, shrunk towards the centroid. A corner between two of these is one of it, too, when
// the line between these two passes the centroid within half the distance of that corner, or on its other side: as the tip of a triangle
// with many straight corners on the side opposite. So the centroid lies within that polygon, and of a convex face all parts are convex and
// cover it.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/polygon.hpp>
#include <brep/refine.hpp>

namespace brep {

// Regular refinement does well up to so many corners: the wedges of an octagon have 3/4 of the proportion of a square.
inline constexpr std::size_t most_regular_corners = 8;

namespace detail {

// The corners of a convex polygon that the inner face has, by their numbers; the first two are not neighbours.
inline std::vector<std::size_t> corners_of_inner_face(Polygon outline, const glm::dvec3& centre) {
  const std::size_t n = outline.size();
  const glm::dvec3 up = normal(outline);
  const auto is_needed = [&](std::size_t i) {
    const glm::dvec3 &a = outline[(i + n - 1) % n], &b = outline[(i + 1) % n];
    const glm::dvec3 inwards = glm::cross(up, b - a);
    return 2.0 * glm::dot(inwards, centre - a) < -glm::dot(inwards, outline[i] - a);
  };
  std::size_t start = 0;  // before a corner that is not needed: some corner never is, none at all in a regular hexagon
  while (start + 1 < n && is_needed(start + 1)) { ++start; }
  std::vector<std::size_t> result{start};
  for (std::size_t k = 2; k < n; k += 2) {
    const std::size_t between = (start + k - 1) % n;
    if (k > 2 && is_needed(between)) { result.push_back(between); }
    result.push_back((start + k) % n);
  }
  if (const std::size_t last = (start + n - 1) % n; n % 2 == 0 && is_needed(last)) { result.push_back(last); }
  return result;
}

}  // namespace detail

// Cuts f into the cells of the ring, in the order of its corners, and the inner face, which keeps the FaceId and comes last. The cells
// start with a copy of its data. place(brep, v) as in refine.
// Refused (nothing changes): f is dead or has fewer than six corners; no handle is left.
// Counts, of m corners of the inner face, at least ceil(n / 2): v + m, e + 2 m, f + m. Time: O(edges of f).
template <class B, class Place>
Result<std::vector<FaceId>> cut_ring(B& brep, FaceId f, Place&& place) {
  if (!brep.alive(f)) { return Refusal{Code::dead, {f}}; }
  const Corners corner = corners(brep, f);
  const std::size_t n = corner.size();
  if (n < 6) { return Refusal{Code::few_corners, {f}}; }
  if (detail::Raw::halfedges(brep).size() > 0x7ffffff0u - 8 * static_cast<std::uint32_t>(n)) { return Refusal{Code::full, {}}; }
  const unsigned level = brep.data(f).level;

  std::vector<glm::dvec3> outline;
  for (std::size_t k = 0; k < n; ++k) { outline.push_back(brep.data(brep.vertex(corner[k])).position); }
  const glm::dvec3 centre = centroid(Polygon(outline));
  const std::vector<std::size_t> kept = detail::corners_of_inner_face(Polygon(outline), centre);
  const std::size_t m = kept.size();
  double width = 0.0, radius = 0.0;
  for (std::size_t k = 0; k < m; ++k) {
    width += glm::distance(outline[kept[k]], outline[kept[k + 1 < m ? k + 1 : 0]]);
    radius += glm::distance(outline[kept[k]], centre);
  }
  // Depth radius (1 - x), mean width width (1 + x) / 2, both the same; narrow faces keep an inner face.
  const double a = 0.5 * width / radius, x = a < 0.8 ? (1.0 - a) / (1.0 + a) : 1.0 / 9.0;
  const auto inner = [&](std::size_t k) { return centre + x * (outline[kept[k]] - centre); };

  std::vector<FaceId> cells;
  cells.reserve(m + 1);
  const auto insert = [&](HalfedgeId h, std::size_t k) {
    const HalfedgeId from = unchecked::split_edge(brep, h);
    detail::put(brep, brep.vertex(from), inner(k), level, place);
    return from;
  };
  HalfedgeId h = detail::cut_child(brep, corner[kept[0]], corner[kept[1]], cells);
  const HalfedgeId first = insert(h, 0);
  HalfedgeId spoke = insert(first, 1);  // inner corner k -> its corner
  for (std::size_t k = 1; k + 1 < m; ++k) {
    h = detail::cut_child(brep, spoke, corner[kept[k + 1]], cells);
    spoke = insert(h, k + 1);
  }
  detail::cut_child(brep, spoke, first, cells);
  for (std::size_t k = 0; k < m; ++k) { brep.set_anchor(cells[k], corner[kept[k]]); }
  brep.set_anchor(f, first);
  cells.push_back(f);
  return cells;
}

}  // namespace brep
