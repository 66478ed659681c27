// SPDX-License-Identifier: MIT
#pragma once

// What round objects share: a frame about an axis, the points of a circle, and how many of them keep a chord error.

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>

namespace raycast {

// A right-handed frame u, v, w of unit vectors; w points along the axis, which is not zero.
struct AxisFrame {
  glm::dvec3 u{0.0}, v{0.0}, w{0.0};

  explicit AxisFrame(const glm::dvec3& axis);

  // Unit vector across the axis towards the point f (relative to a point of the axis); u for a point on the axis.
  [[nodiscard]] glm::dvec3 radial(const glm::dvec3& f) const {
    const double x = glm::dot(f, u), y = glm::dot(f, v), length = std::hypot(x, y);
    return length > 0.0 ? glm::normalize((x / length) * u + (y / length) * v) : u;
  }

  // The map into the frame, in units of `across` and of `along` the axis.
  [[nodiscard]] glm::dmat3 into(double across, double along) const { return glm::transpose(glm::dmat3(u / across, v / across, w / along)); }

  // Adds to the box the circle of this radius about a point of the axis: a disk of unit normal w reaches r sqrt(1 - w_k^2) along axis k.
  void extend(Box& box, const glm::dvec3& centre, double radius) const;
};

// Point i of n on the unit circle, n a multiple of 4. Exact quarter turns of the first quadrant keep opposite points exact mirrors.
[[nodiscard]] glm::dvec2 circle_point(int i, int n);

// The smallest multiple of 4, between 8 and 1024, of points on a unit circle whose chords are off it by `error` at most.
[[nodiscard]] int circle_points(double error);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/circle.cpp>
#endif
