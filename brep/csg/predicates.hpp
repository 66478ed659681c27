// SPDX-License-Identifier: MIT
#pragma once

// All geometric questions of CSG, answered exactly: on which side of a plane is a point, and in which order are two points along an axis.
//
// The common point of three planes is (x, y, z) / w by Cramer's rule; with |n| <= 2^53 and |d| < 2^80 that is |w| < 2^162 and |x| <
// 2^189, so side() = a x + b y + c z + d w stays below 2^244 and compare() = x w' - x' w below 2^352. The order of points on a line is
// their order along an axis that is not perpendicular to it; the order of directions in a plane and of faces around an edge needs cross
// products of integer normals alone. Nothing takes a root, an angle or a quotient.
//
// Filter: a point keeps its coordinates rounded down to a multiple of 2^-27. With N = |a| + |b| + |c|, a x + b y + c z + d in doubles is
// wrong by less than N 2^-27 for the coordinates and N 2^-25 for rounding; beyond N 2^-24 its sign is right. Rounding down is monotone
// and the same for equal points: points with different rounded coordinates have the order of these, and equal points have equal ones, so a
// hash of the rounded coordinates finds them (point_table.hpp).

#include <array>
#include <cstddef>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/wide.hpp>

namespace brep::csg {

template <std::size_t N>
struct Homogeneous {
  std::array<Wide<N>, 3> x;
  Wide<N> w;  // positive
};

namespace detail {

// n x m, component i. Below 2^107.
[[nodiscard]] inline Int128 cross(const Plane& p, const Plane& q, std::size_t i) {
  const std::size_t j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
  return static_cast<Int128>(p.n[j]) * q.n[k] - static_cast<Int128>(p.n[k]) * q.n[j];
}
[[nodiscard]] inline int sign(Int128 x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
[[nodiscard]] inline int sign(double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; }

// The exact coordinates of the point of three planes, or w = 0 when there is not just one.
[[nodiscard]] Homogeneous<4> meet(const Plane& p, const Plane& q, const Plane& r);

}  // namespace detail

// The questions about points on the planes of one grid.
class Predicates {
 public:
  explicit Predicates(const PlaneTable& planes) : planes_(&planes) {}

  [[nodiscard]] const Plane& plane(PlaneNumber p) const { return (*planes_)[p]; }

  // The point of three planes in general position.
  [[nodiscard]] Point point(PlaneNumber p, PlaneNumber q, PlaneNumber r) const;

  [[nodiscard]] Homogeneous<4> exact(const Point& v) const;

  // +1: where the canonical normal of q points, 0: on q, -1: behind.
  [[nodiscard]] int side(const Point& v, PlaneNumber number) const;

  // The order of two points along an axis.
  [[nodiscard]] int compare(const Point& v, const Point& w, int axis) const;

  [[nodiscard]] bool equal(const Point& v, const Point& w) const;

 private:
  [[nodiscard]] int exact_side(const Point& v, PlaneNumber number) const;

  const PlaneTable* planes_;
};

// The line of two planes that are not parallel, with an axis that tells the order of its points.
struct Line {
  int axis = -1;      // where the direction is largest; -1: the planes are parallel
  int direction = 0;  // sign of n_p x n_q on that axis

  Line(const Plane& p, const Plane& q);
};

}  // namespace brep::csg

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/predicates.cpp>
#endif
