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

#include <cmath>
#include <cstddef>
#include <cstdint>

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
[[nodiscard]] inline Homogeneous<4> meet(const Plane& p, const Plane& q, const Plane& r) {
  Homogeneous<4> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Int128 qr = cross(q, r, i);
    result.x[i] = -(product(p.d, qr) + product(q.d, cross(r, p, i)) + product(r.d, cross(p, q, i)));
    result.w = result.w + product(p.n[i], qr);
  }
  if (result.w.negative()) {
    result.w = -result.w;
    for (auto& x : result.x) { x = -x; }
  }
  return result;
}

}  // namespace detail

// The questions about points on the planes of one grid.
class Predicates {
 public:
  explicit Predicates(const PlaneTable& planes) : planes_(&planes) {}

  [[nodiscard]] const Plane& plane(PlaneNumber p) const { return (*planes_)[p]; }

  // The point of three planes in general position.
  [[nodiscard]] Point point(PlaneNumber p, PlaneNumber q, PlaneNumber r) const {
    const Homogeneous<4> h = detail::meet(plane(p), plane(q), plane(r));
    Point result;
    result.planes = {p, q, r};
    bool integer = true;
    const double divisor = h.w.approximate();
    for (int i = 0; i < 3; ++i) {
      const Wide<4> scaled = h.x[static_cast<std::size_t>(i)] * Wide<4>(Int128{1} << 27);
      auto quotient = static_cast<std::int64_t>(std::floor(scaled.approximate() / divisor));
      Wide<4> rest = scaled - h.w * Wide<4>(quotient);
      while (rest.negative()) { rest = rest + h.w, --quotient; }
      for (Wide<4> less = rest - h.w; !less.negative(); less = rest - h.w) { rest = less, ++quotient; }
      integer = integer && rest.zero() && (quotient & ((1 << 27) - 1)) == 0;
      result.position[i] = static_cast<double>(quotient) * 0x1p-27;
    }
    if (integer) { result.planes = {invalid_index, invalid_index, invalid_index}; }
    return result;
  }

  [[nodiscard]] Homogeneous<4> exact(const Point& v) const {
    if (!v.on_grid()) { return detail::meet(plane(v.planes[0]), plane(v.planes[1]), plane(v.planes[2])); }
    Homogeneous<4> result;
    for (int i = 0; i < 3; ++i) { result.x[static_cast<std::size_t>(i)] = Wide<4>(static_cast<std::int64_t>(v.position[i])); }
    result.w = Wide<4>(1);
    return result;
  }

  // +1: where the canonical normal of q points, 0: on q, -1: behind.
  [[nodiscard]] int side(const Point& v, PlaneNumber number) const {
    const Plane& q = plane(number);
    const double value = q.normal[0] * v.position.x + q.normal[1] * v.position.y + q.normal[2] * v.position.z + q.offset;
    if (value > q.bound) { return 1; }
    if (value < -q.bound) { return -1; }
    return exact_side(v, number);
  }

  // The order of two points along an axis.
  [[nodiscard]] int compare(const Point& v, const Point& w, int axis) const {
    if (v.position[axis] != w.position[axis]) { return v.position[axis] < w.position[axis] ? -1 : 1; }
    if (v.on_grid() && w.on_grid()) { return 0; }
    if (v.planes == w.planes) { return 0; }
    const Homogeneous<4> a = exact(v), b = exact(w);
    const auto i = static_cast<std::size_t>(axis);
    return (Wide<6>(a.x[i]) * Wide<6>(b.w) - Wide<6>(b.x[i]) * Wide<6>(a.w)).sign();
  }

  [[nodiscard]] bool equal(const Point& v, const Point& w) const {
    if (v.position != w.position || v.on_grid() != w.on_grid()) { return false; }
    if (v.on_grid() || v.planes == w.planes) { return true; }
    return side(v, w.planes[0]) == 0 && side(v, w.planes[1]) == 0 && side(v, w.planes[2]) == 0;
  }

 private:
  [[nodiscard]] int exact_side(const Point& v, PlaneNumber number) const {
    const Plane& q = plane(number);
    if (v.on_grid()) {
      Int128 sum = q.d;
      for (int i = 0; i < 3; ++i) {
        sum += static_cast<Int128>(q.n[static_cast<std::size_t>(i)]) * static_cast<std::int64_t>(v.position[i]);
      }
      return detail::sign(sum);
    }
    if (v.planes[0] == number || v.planes[1] == number || v.planes[2] == number) { return 0; }
    const Homogeneous<4> h = exact(v);
    Wide<4> sum = h.w * Wide<4>(q.d);
    for (std::size_t i = 0; i < 3; ++i) { sum = sum + h.x[i] * Wide<4>(q.n[i]); }
    return sum.sign();
  }

  const PlaneTable* planes_;
};

// The line of two planes that are not parallel, with an axis that tells the order of its points.
struct Line {
  int axis = -1;      // where the direction is largest; -1: the planes are parallel
  int direction = 0;  // sign of n_p x n_q on that axis

  Line(const Plane& p, const Plane& q) {
    Int128 largest = 0;
    for (int i = 0; i < 3; ++i) {
      const Int128 c = detail::cross(p, q, static_cast<std::size_t>(i));
      if (detail::size(c) > largest) { largest = detail::size(c), axis = i, direction = detail::sign(c); }
    }
  }
};

}  // namespace brep::csg
