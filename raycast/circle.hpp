// SPDX-License-Identifier: MIT
#pragma once

// Common parts of round objects: a frame about an axis, points on a circle, and the number of points for a given chord error.

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/spans.hpp>

namespace raycast {

// A right-handed frame of unit vectors u, v, w, with w along the axis, which must not be zero.
struct AxisFrame {
  glm::dvec3 u{0.0}, v{0.0}, w{0.0};

  explicit AxisFrame(const glm::dvec3& axis);

  // Unit vector from the axis towards the point f (relative to a point of the axis), perpendicular to it; u if f lies on the axis.
  [[nodiscard]] glm::dvec3 radial(const glm::dvec3& f) const {
    const double x = glm::dot(f, u), y = glm::dot(f, v), length = std::hypot(x, y);
    return length > 0.0 ? glm::normalize((x / length) * u + (y / length) * v) : u;
  }

  // The map into the frame, in units of `across` perpendicular to the axis and of `along` parallel to it.
  [[nodiscard]] glm::dmat3 into(double across, double along) const { return glm::transpose(glm::dmat3(u / across, v / across, w / along)); }

  // Extends the box by a circle of this radius about a point of the axis: a disk with unit normal w extends r sqrt(1 - w_k^2) along axis k.
  void extend(Box& box, const glm::dvec3& centre, double radius) const;
};

// Clips the span of a line within the infinite side of a round solid to the part between its bottom (sheet 1, at z = 0) and its top, at
// z = height; the line is at z + (t - shift) dz. Returns false if it runs parallel to both and not between them.
[[nodiscard]] inline bool clip_between_caps(Span& span, double z, double dz, double shift, double height, std::uint32_t top_sheet) {
  if (dz == 0.0) { return z >= 0.0 && z <= height; }
  const Crossing bottom{shift - z / dz, 1}, top{shift + (height - z) / dz, top_sheet};
  const Crossing& in = dz > 0.0 ? bottom : top;
  const Crossing& leave = dz > 0.0 ? top : bottom;
  if (in.t > span.in.t) { span.in = in; }
  if (leave.t < span.out.t) { span.out = leave; }
  return true;
}

// Point i of n on the unit circle, n a multiple of 4. The other quadrants are exact rotations of the first, so opposite points are exact
// mirrors.
[[nodiscard]] glm::dvec2 circle_point(int i, int n);

// The smallest multiple of 4, between 8 and 1024, of points on a unit circle for which the chords are off by at most `error`.
[[nodiscard]] int circle_points(double error);

// The number of rows in which facets of this width lie along the straight side of a round object, between 1 and 64: they are about as long
// as wide. But along a thin pole, whose sides are flat for the tolerance, they are no shorter than those of a sphere of the same size: a
// facet of the width w on a sphere of radius r departs from it by w^2 / 8r, and the size, the diagonal of its bounds, is 2 sqrt(3) r.
[[nodiscard]] int rows_along(double length, double width, double radius, double tolerance);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/circle.cpp>
#endif
