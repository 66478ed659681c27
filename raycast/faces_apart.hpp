// SPDX-License-Identifier: MIT
#pragma once

// Do the faces of a mesh meet nowhere but in the corners and the edges that they share? Then a closed mesh is embedded: it divides space in
// two, and along every line entries and exits alternate.
//
// The answer is that for each pair of faces whose bounds overlap a plane has been found between them: through what they share, with all
// other corners of one face on one side of it and those of the other on the other side or on it (the theorem of separating planes, tried
// with the planes of the faces, those that stand on their edges, and those along an edge of each). At first their convex hulls stand for
// the faces; where no plane is found, because one of them has notches, their triangles do.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/bvh.hpp>

namespace raycast {

// A face: its corners, as indices into the positions of the mesh, and a unit normal, which need not be exact.
struct MeshFace {
  std::span<const std::uint32_t> corners;
  glm::dvec3 normal;
};

// True is certain, up to tol_between of a face's size around what it shares; `rounding` is that of a height above a plane, and `bvh` is
// that of the faces' bounds; when empty, every pair is looked at.
[[nodiscard]] bool faces_apart(const std::vector<MeshFace>& faces, const std::vector<glm::dvec3>& positions, const Bvh& bvh,
                               double rounding);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/faces_apart.cpp>
#endif
