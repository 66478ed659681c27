// SPDX-License-Identifier: MIT
#include <brep/csg/point_in_solid.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/wide.hpp>
#include <brep/csg/work.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE Sample PointInSolid::middle(std::uint32_t p, std::uint32_t q) const {
  const Homogeneous<10> a = widened(work_.points[p]), b = widened(work_.points[q]);
  Sample result{0.5 * work_.points[p].position + 0.5 * work_.points[q].position, {}};
  for (std::size_t i = 0; i < 3; ++i) { result.exact.x[i] = a.x[i] * b.w + b.x[i] * a.w; }
  result.exact.w = a.w * b.w + a.w * b.w;
  return result;
}

HALFLIGHT_INLINE int PointInSolid::operator()(const Sample& v) const {
  bool inside = false;
  for (const WorkFace& face : work_.faces) {
    if (face.of_b != of_b_) { continue; }
    const Box& box = face.box;
    if (v.position.x > box.hi[0] + near || v.position.y > box.hi[1] + near || v.position.z > box.hi[2] + near) { continue; }
    if (v.position.y < box.lo[1] - near || v.position.z < box.lo[2] - near || !passes(face, v)) { continue; }
    const int s = side(v, work_.plane(face));
    if (s == 0) { return 0; }
    if ((s > 0) == (work_.plane(face).n[0] < 0)) { inside = !inside; }
  }
  return inside ? 1 : -1;
}

HALFLIGHT_INLINE Homogeneous<10> PointInSolid::widened(const Point& p) const {
  const Homogeneous<4> h = work_.predicates.exact(p);
  Homogeneous<10> result;
  for (std::size_t i = 0; i < 3; ++i) { result.x[i] = Wide<10>(h.x[i]); }
  result.w = Wide<10>(h.w);
  return result;
}

HALFLIGHT_INLINE bool PointInSolid::passes(const WorkFace& face, const Sample& v) const {
  bool odd = false;
  for (std::uint32_t i = 0; i < face.count; ++i) {
    const std::uint32_t h = work_.half(face, i);
    const Point &a = work_.from(h), &b = work_.to(h);
    if (below(a, v) == below(b, v)) { continue; }
    if (a.position.y < v.position.y - near && b.position.y < v.position.y - near) { continue; }
    if ((a.position.y > v.position.y + near && b.position.y > v.position.y + near) ||
        left(work_.plane(face), work_.predicates.plane(work_.halves[h].across), v)) {
      odd = !odd;
    }
  }
  return odd;
}

HALFLIGHT_INLINE bool PointInSolid::below(const Point& a, const Sample& v) const {
  if (a.position.z < v.position.z - near) { return true; }
  if (a.position.z > v.position.z + near) { return false; }
  const Homogeneous<10> e = widened(a);
  return (e.x[2] * v.exact.w - v.exact.x[2] * e.w).sign() <= 0;
}

HALFLIGHT_INLINE bool PointInSolid::left(const Plane& p, const Plane& q, const Sample& v) {
  const Int128 b = -cross(p, q, 2), c = cross(p, q, 1);
  const Wide<10> d = Wide<10>(q.n[0]) * Wide<10>(p.d) - Wide<10>(p.n[0]) * Wide<10>(q.d);
  int s = (Wide<10>(b) * v.exact.x[1] + Wide<10>(c) * v.exact.x[2] + d * v.exact.w).sign();
  if (s == 0) { s = c != 0 ? detail::sign(c) : detail::sign(b); }
  return s * detail::sign(b) < 0;
}

HALFLIGHT_INLINE int PointInSolid::side(const Sample& v, const Plane& p) {
  const double value = p.normal[0] * v.position.x + p.normal[1] * v.position.y + p.normal[2] * v.position.z + p.offset;
  if (std::abs(value) > 4.0 * p.bound) { return detail::sign(value); }
  Wide<10> sum = v.exact.w * Wide<10>(p.d);
  for (std::size_t i = 0; i < 3; ++i) { sum = sum + v.exact.x[i] * Wide<10>(p.n[i]); }
  return sum.sign();
}

}  // namespace brep::csg::detail
