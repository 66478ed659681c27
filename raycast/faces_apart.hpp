// SPDX-License-Identifier: MIT
#pragma once

// Do the faces of a mesh meet only in the corners and edges that they share? Then a closed mesh is embedded: it divides space in two, and
// along every line entries and exits alternate.
//
// For each pair of faces whose bounds overlap, a separating plane is searched: through the shared corners, with all other corners of one
// face on one side, and those of the other face on the other side or on the plane (separating axis theorem, tried with the planes of the
// faces, planes perpendicular to them through their edges, and planes along an edge of each). At first the convex hulls of the faces are
// used; if no plane is found because a face is not convex, its triangles.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/bvh.hpp>

namespace raycast {

// A face: its corners, as indices into the positions of the mesh, and an approximate unit normal.
struct MeshFace {
  std::span<const std::uint32_t> corners;
  glm::dvec3 normal;
};

// True is certain, up to tol_between of a face's size near the shared corners. `rounding`: error of a height above a plane. `bvh`: tree
// of the faces' bounds; if empty, every pair is tested.
[[nodiscard]] bool faces_apart(const std::vector<MeshFace>& faces, const std::vector<glm::dvec3>& positions, const Bvh& bvh,
                               double rounding);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/faces_apart.cpp>
#endif
