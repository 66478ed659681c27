// SPDX-License-Identifier: MIT
#pragma once

// Do two faces of a mesh meet nowhere but in the corner or the edge that both have? Asked of all pairs whose bounds overlap, it tells
// whether a closed mesh is embedded: then it divides space in two, and along every line entries and exits alternate.
//
// The answer is that a plane has been found between them: through what they share, with all other corners of one face on one side of it and
// those of the other on the other side or on it (the theorem of separating planes, tried with the planes of the faces, those that stand on
// their edges, and those along an edge of each). Their convex hulls stand for the faces, so it may be that no plane is found for faces with
// notches that are apart.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace raycast {

// A face: its corners, as indices into the positions of the mesh, and a unit normal, which need not be exact.
struct MeshFace {
  std::span<const std::uint32_t> corners;
  glm::dvec3 normal;
};

// True is certain, up to tol_between of the faces' size around what they share; `rounding` is that of a height above a plane.
[[nodiscard]] bool apart_but_for_shared(const MeshFace& a, const MeshFace& b, const std::vector<glm::dvec3>& positions, double rounding);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/faces_apart.cpp>
#endif
