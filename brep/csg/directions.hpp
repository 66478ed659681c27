// SPDX-License-Identifier: MIT
#pragma once

// Directions of edges as seen on a face from outside, in exact integers.
//
// The direction of a half-edge is +-(n_p x n_q) for the plane p of its face and a second plane q of its line; the sign comes from the
// order of its ends along an axis. Dropping the coordinate where the normal of the face is largest leaves two of 107 bits each, in an
// order in which counter-clockwise from outside is counter-clockwise; a cross product of two directions has 215 bits.

#include <cstddef>
#include <utility>

#include <brep/csg/work.hpp>

namespace brep::csg::detail {

// The coordinate plane onto which a face is projected: u to the right and v up.
struct Projection {
  int u, v;

  explicit Projection(const Plane& plane, int sign) {
    const auto size = [&](std::size_t i) { return plane.n[i] < 0 ? -plane.n[i] : plane.n[i]; };
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i) { k = size(i) > size(k) ? i : k; }
    u = static_cast<int>(k == 2 ? 0 : k + 1), v = static_cast<int>(k == 0 ? 2 : k - 1);
    if ((plane.n[k] < 0) != (sign < 0)) { std::swap(u, v); }
  }
};

struct Direction {
  Int128 u = 0, v = 0;

  // 0 for angles in [0, 180) degrees from the u axis, 1 for the others.
  [[nodiscard]] int half() const { return v > 0 || (v == 0 && u > 0) ? 0 : 1; }
};

// The sign of a x b: 1 when b is counter-clockwise of a by less than 180 degrees.
[[nodiscard]] inline int turn(const Direction& a, const Direction& b) {
  const double x = static_cast<double>(a.u) * static_cast<double>(b.v), y = static_cast<double>(a.v) * static_cast<double>(b.u);
  const double value = x - y, bound = (std::abs(x) + std::abs(y)) * 0x1p-50;
  if (value > bound) { return 1; }
  if (value < -bound) { return -1; }
  return (product(a.u, b.v) - product(a.v, b.u)).sign();
}
// Order of angles in [0, 360) degrees from the u axis.
[[nodiscard]] inline bool before(const Direction& a, const Direction& b) {
  return a.half() != b.half() ? a.half() < b.half() : turn(a, b) > 0;
}

// From one point to another on the line of the planes of a face and `across`.
[[nodiscard]] inline Direction direction(const Work& w, const Plane& plane, PlaneNumber across, const Projection& on, const Point& from,
                                         const Point& to) {
  const Plane& other = w.predicates.plane(across);
  const Line line(plane, other);
  const bool along = w.predicates.compare(from, to, line.axis) < 0;
  const Int128 s = along == (line.direction > 0) ? 1 : -1;
  return {s * cross(plane, other, static_cast<std::size_t>(on.u)), s * cross(plane, other, static_cast<std::size_t>(on.v))};
}

}  // namespace brep::csg::detail
