// SPDX-License-Identifier: MIT
#pragma once

// Maps a point of a curved surface to the corresponding point of the triangle that approximates the surface there.
//
// Moving the three corners along the surface normals by a common offset s sweeps a prism. A point x of the prism lies in the triangle of
// one offset; its barycentric coordinates in that triangle are those of x. Triangles that share an edge and its two normals share the
// ruled wall between their prisms, on which both give the same coordinates. So values interpolated with these coordinates are continuous
// over the true surface, and exact at the corners. (The nearest point on the mesh would not be unique where the mesh is concave, and
// would not move while x passes over a convex edge.) On a plane the result is the foot of the perpendicular.
//
// The offset is a root of (x - a(s)) . N(s), which is cubic in s, with a(s) the moved corner and N(s) the normal of the moved triangle.
// The root that belongs to the surface lies near 0 and is found by Newton's method starting there.

#include <algorithm>
#include <array>
#include <optional>

#include <glm/vec3.hpp>

namespace radiosity {

struct ChordTriangle {
  std::array<glm::dvec3, 3> position{glm::dvec3{0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}};  // counter-clockwise seen from outside
  std::array<glm::dvec3, 3> normal{glm::dvec3{0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}};    // of the surface, at the corners
};

struct ChordPoint {
  glm::dvec3 weight{0.0};  // barycentric coordinates, summing to 1; a negative one means that the point lies outside
  double offset = 0.0;     // along the interpolated normal

  // The smallest weight: positive inside, negative outside.
  [[nodiscard]] double depth() const { return std::min({weight.x, weight.y, weight.z}); }
};

// The point of the triangle that corresponds to x. Nothing if the triangle has no area or no such offset near 0 exists.
[[nodiscard]] std::optional<ChordPoint> chord_point(const ChordTriangle& triangle, const glm::dvec3& x);

// The barycentric coordinates, none negative, of the point of the flat triangle that is nearest to x. A triangle without area is treated
// as its longest edge.
[[nodiscard]] glm::dvec3 nearest_in_triangle(const std::array<glm::dvec3, 3>& p, const glm::dvec3& x);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/chord.cpp>
#endif
