// SPDX-License-Identifier: MIT
#pragma once

// Between a curved surface and the triangles that stand for it: which point of a triangle is meant by a point of the surface?
//
// Moving the three corners along the surface's normals there by a common offset s sweeps a prism; a point x of it lies in the triangle
// of one offset, and its barycentric coordinates there are those of x. Triangles that share an edge and its two normals share the ruled
// wall between their prisms, on which both give the same coordinates: what is interpolated by them is continuous over the true surface,
// and exact at the corners. (A nearest point on the mesh would neither be unique where the mesh is concave, nor would it move while x
// passes over a convex edge.) On a plane it is the foot of the perpendicular.
//
// The offset is a root of (x - a(s)) . N(s), cubic in s, with a(s) the moved corner and N(s) the normal of the moved triangle. The
// root that belongs to the surface lies near 0 and is found by Newton's method from there.

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
  glm::dvec3 weight{0.0};  // barycentric; they sum to 1, and a negative one says that the point is outside
  double offset = 0.0;     // along the interpolated normal

  // How far inside: the smallest weight.
  [[nodiscard]] double depth() const { return std::min({weight.x, weight.y, weight.z}); }
};

// The point of the triangle that stands for x. Nothing when the triangle has no area or there is no such offset near 0.
[[nodiscard]] std::optional<ChordPoint> chord_point(const ChordTriangle& triangle, const glm::dvec3& x);

// The barycentric coordinates of the point of the flat triangle that is nearest to x (none of them negative). A triangle without area
// is its longest edge.
[[nodiscard]] glm::dvec3 nearest_in_triangle(const std::array<glm::dvec3, 3>& p, const glm::dvec3& x);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/chord.cpp>
#endif
