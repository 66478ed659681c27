// SPDX-License-Identifier: MIT
#include <raycast/objects/box.hpp>

#include <cstdint>
#include <memory>
#include <string>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

HALFLIGHT_INLINE Made<BoxObject> BoxObject::make(const glm::dvec3& lo, const glm::dvec3& hi) {
  if (!usable(lo) || !usable(hi)) { return "a box's corners must be finite (and below 1e60)"; }
  const double magnitude = Box{glm::min(lo, hi), glm::max(lo, hi)}.magnitude();
  for (int k = 0; k < 3; ++k) {
    if (!usable_length(hi[k] - lo[k], magnitude)) {
      return std::string("a box must have a positive size along ") + "xyz"[k] + ": its first corner must be below its second";
    }
  }
  return std::shared_ptr<const BoxObject>(new BoxObject(Box{lo, hi}));
}

HALFLIGHT_INLINE void BoxObject::spans(const Segment& line, Spans& out) const {
  Span span{{-infinity, 0}, {infinity, 0}};
  if (!clip(0, box_.lo.x, box_.hi.x, line.origin.x, line.direction.x, span)) { return; }
  if (!clip(2, box_.lo.y, box_.hi.y, line.origin.y, line.direction.y, span)) { return; }
  if (!clip(4, box_.lo.z, box_.hi.z, line.origin.z, line.direction.z, span)) { return; }
  out.push(span);  // drops an empty span
}

HALFLIGHT_INLINE void BoxObject::compile(Compiler& compiler) const {
  Plane planes[6];
  for (std::uint32_t sheet = 0; sheet < 6; ++sheet) {
    const SurfacePoint at = project(sheet, box_.centre());
    planes[sheet] = {at.position, at.normal};
  }
  compiler.body(planes);
}

HALFLIGHT_INLINE void BoxObject::approximate(double, brep::Builder& out) const {
  std::uint32_t v[8] = {};  // numbered as Box::corner
  for (unsigned i = 0; i < 8; ++i) { v[i] = out.vertex(box_.corner(i)); }
  out.face({v[0], v[4], v[6], v[2]}, 0);
  out.face({v[1], v[3], v[7], v[5]}, 1);
  out.face({v[0], v[1], v[5], v[4]}, 2);
  out.face({v[2], v[6], v[7], v[3]}, 3);
  out.face({v[0], v[2], v[3], v[1]}, 4);
  out.face({v[4], v[5], v[7], v[6]}, 5);
}

HALFLIGHT_INLINE SurfacePoint BoxObject::project(std::uint32_t sheet, const glm::dvec3& p) const {
  const int k = static_cast<int>(sheet / 2);
  SurfacePoint result{p, glm::dvec3{0.0}};
  result.position[k] = sheet % 2 ? box_.hi[k] : box_.lo[k];
  result.normal[k] = sheet % 2 ? 1.0 : -1.0;
  return result;
}

HALFLIGHT_INLINE bool BoxObject::clip(std::uint32_t lower, double lo, double hi, double origin, double direction, Span& span) {
  if (direction == 0.0) { return lo <= origin && origin <= hi; }
  const double to_lo = (lo - origin) / direction, to_hi = (hi - origin) / direction;
  const bool forward = direction > 0.0;
  const Crossing in{forward ? to_lo : to_hi, forward ? lower : lower + 1};
  const Crossing out{forward ? to_hi : to_lo, forward ? lower + 1 : lower};
  // For a denormal direction these are infinite, or 0/denormal = 0 on the plane itself, but never NaN.
  if (in.t > span.in.t) { span.in = in; }
  if (out.t < span.out.t) { span.out = out; }
  return span.in.t <= span.out.t;
}

}  // namespace raycast
