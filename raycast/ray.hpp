// SPDX-License-Identifier: MIT
#pragma once

// A ray is a segment: origin + t * direction, with t in [0,1] from one end to the other. The direction is the difference of the ends and
// is never normalised, so t has no unit and all answers in raycast/ are independent of scale: multiplying all coordinates of a scene by a
// power of two leaves each t bit-identical. Outside [0,1] the same formula gives the points of the whole line.
//
// Accuracy: u = 2^-53 is the unit roundoff of double; bounds in comments are multiples of u (tolerances.hpp).

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/tolerances.hpp>

namespace raycast {

struct Segment {
  glm::dvec3 origin{0.0}, direction{0.0};

  [[nodiscard]] glm::dvec3 at(double t) const { return origin + t * direction; }
};

// The segment from a to b.
[[nodiscard]] inline Segment between(const glm::dvec3& a, const glm::dvec3& b) { return Segment{a, b - a}; }

// False if the direction is so short that its square underflows (length below about 1e-150; scenes that small are refused), and for NaN
// and infinite directions. Such rays meet nothing.
[[nodiscard]] inline bool has_line(const Segment& s) {
  const double squared = glm::dot(s.direction, s.direction);
  return squared > smallest_square && squared < largest_square;
}

// The parameter of the point of the line nearest to `centre`. Moving the origin there before solving a quadratic removes terms in
// distance^2 that would cancel in the discriminant: a sphere seen from 10^6 radii is then accurate to 1e-8 instead of lost. Requires
// has_line.
[[nodiscard]] inline double nearest_parameter(const Segment& s, const glm::dvec3& centre) {
  return glm::dot(centre - s.origin, s.direction) / glm::dot(s.direction, s.direction);
}

}  // namespace raycast
