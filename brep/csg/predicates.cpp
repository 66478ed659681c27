// SPDX-License-Identifier: MIT
#include <brep/csg/predicates.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/wide.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg {

namespace detail {

HALFLIGHT_INLINE Homogeneous<4> meet(const Plane& p, const Plane& q, const Plane& r) {
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

HALFLIGHT_INLINE Point Predicates::point(PlaneNumber p, PlaneNumber q, PlaneNumber r) const {
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

HALFLIGHT_INLINE Homogeneous<4> Predicates::exact(const Point& v) const {
  if (!v.on_grid()) { return detail::meet(plane(v.planes[0]), plane(v.planes[1]), plane(v.planes[2])); }
  Homogeneous<4> result;
  for (int i = 0; i < 3; ++i) { result.x[static_cast<std::size_t>(i)] = Wide<4>(static_cast<std::int64_t>(v.position[i])); }
  result.w = Wide<4>(1);
  return result;
}

HALFLIGHT_INLINE int Predicates::side(const Point& v, PlaneNumber number) const {
  const Plane& q = plane(number);
  const double value = q.normal[0] * v.position.x + q.normal[1] * v.position.y + q.normal[2] * v.position.z + q.offset;
  if (value > q.bound) { return 1; }
  if (value < -q.bound) { return -1; }
  return exact_side(v, number);
}

HALFLIGHT_INLINE int Predicates::compare(const Point& v, const Point& w, int axis) const {
  if (v.position[axis] != w.position[axis]) { return v.position[axis] < w.position[axis] ? -1 : 1; }
  if (v.on_grid() && w.on_grid()) { return 0; }
  if (v.planes == w.planes) { return 0; }
  const Homogeneous<4> a = exact(v), b = exact(w);
  const auto i = static_cast<std::size_t>(axis);
  return (Wide<6>(a.x[i]) * Wide<6>(b.w) - Wide<6>(b.x[i]) * Wide<6>(a.w)).sign();
}

HALFLIGHT_INLINE bool Predicates::equal(const Point& v, const Point& w) const {
  if (v.position != w.position || v.on_grid() != w.on_grid()) { return false; }
  if (v.on_grid() || v.planes == w.planes) { return true; }
  return side(v, w.planes[0]) == 0 && side(v, w.planes[1]) == 0 && side(v, w.planes[2]) == 0;
}

HALFLIGHT_INLINE int Predicates::exact_side(const Point& v, PlaneNumber number) const {
  const Plane& q = plane(number);
  if (v.on_grid()) {
    Int128 sum = q.d;
    for (int i = 0; i < 3; ++i) { sum += static_cast<Int128>(q.n[static_cast<std::size_t>(i)]) * static_cast<std::int64_t>(v.position[i]); }
    return detail::sign(sum);
  }
  if (v.planes[0] == number || v.planes[1] == number || v.planes[2] == number) { return 0; }
  const Homogeneous<4> h = exact(v);
  Wide<4> sum = h.w * Wide<4>(q.d);
  for (std::size_t i = 0; i < 3; ++i) { sum = sum + h.x[i] * Wide<4>(q.n[i]); }
  return sum.sign();
}

HALFLIGHT_INLINE Line::Line(const Plane& p, const Plane& q) {
  Int128 largest = 0;
  for (int i = 0; i < 3; ++i) {
    const Int128 c = detail::cross(p, q, static_cast<std::size_t>(i));
    if (detail::size(c) > largest) { largest = detail::size(c), axis = i, direction = detail::sign(c); }
  }
}

}  // namespace brep::csg
