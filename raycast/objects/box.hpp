// SPDX-License-Identifier: MIT
#pragma once

// The axis-aligned box lo..hi (the shape, not the bounds of box.hpp); six sheets x0 x1 y0 y1 z0 z1.
//
// Intersection by slabs: each crossing is one rounded difference divided once, so t is exact to 2u relative, and a line that leaves the
// box from a point of one of its faces has its exit within 2u of that point or behind it.

#include "../compile.hpp"
#include "../object.hpp"

namespace raycast {

class BoxObject final : public Object {
 public:
  // Refused: non-finite or huge coordinates; an edge that is not positive or vanishes beside the coordinates.
  static Made<BoxObject> make(const glm::dvec3& lo, const glm::dvec3& hi) {
    if (!usable(lo) || !usable(hi)) return "a box's corners must be finite (and below 1e60)";
    const double magnitude = Box{glm::min(lo, hi), glm::max(lo, hi)}.magnitude();
    for (int k = 0; k < 3; ++k)
      if (!usable_length(hi[k] - lo[k], magnitude))
        return std::string("a box must have a positive size along ") + "xyz"[k] + ": its first corner must be below its second";
    return std::shared_ptr<const BoxObject>(new BoxObject(Box{lo, hi}));
  }

  [[nodiscard]] Box bounds() const override { return box_; }
  [[nodiscard]] bool convex() const override { return true; }
  [[nodiscard]] bool flat() const override { return true; }
  [[nodiscard]] std::uint32_t sheet_count() const override { return 6; }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override {
    constexpr std::string_view names[6] = {"x0", "x1", "y0", "y1", "z0", "z1"};
    return names[sheet];
  }

  void spans(const Segment& line, Spans& out) const override {
    Span span{{-infinity, 0}, {infinity, 0}};
    if (!clip(0, box_.lo.x, box_.hi.x, line.origin.x, line.direction.x, span)) return;
    if (!clip(2, box_.lo.y, box_.hi.y, line.origin.y, line.direction.y, span)) return;
    if (!clip(4, box_.lo.z, box_.hi.z, line.origin.z, line.direction.z, span)) return;
    out.push(span);  // drops an empty span
  }

  void compile(Compiler& compiler) const override {
    Plane planes[6];
    for (std::uint32_t sheet = 0; sheet < 6; ++sheet) {
      const SurfacePoint at = project(sheet, box_.centre());
      planes[sheet] = {at.position, at.normal};
    }
    compiler.body(planes);
  }

  void approximate(double, brep::Builder& out) const override {
    std::uint32_t v[8] = {};  // bit k of the index: upper end along axis k
    for (unsigned i = 0; i < 8; ++i)
      v[i] = out.vertex({i & 1u ? box_.hi.x : box_.lo.x, i & 2u ? box_.hi.y : box_.lo.y, i & 4u ? box_.hi.z : box_.lo.z});
    out.face({v[0], v[4], v[6], v[2]}, 0);
    out.face({v[1], v[3], v[7], v[5]}, 1);
    out.face({v[0], v[1], v[5], v[4]}, 2);
    out.face({v[2], v[6], v[7], v[3]}, 3);
    out.face({v[0], v[2], v[3], v[1]}, 4);
    out.face({v[4], v[5], v[7], v[6]}, 5);
  }

  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override {
    const int k = static_cast<int>(sheet / 2);
    SurfacePoint result{p, glm::dvec3{0.0}};
    result.position[k] = sheet % 2 ? box_.hi[k] : box_.lo[k];
    result.normal[k] = sheet % 2 ? 1.0 : -1.0;
    return result;
  }

 private:
  explicit BoxObject(const Box& box) : box_(box) {}

  // A line parallel to the slab is inside it when its origin is, the bounding planes included.
  static bool clip(std::uint32_t lower, double lo, double hi, double origin, double direction, Span& span) {
    if (direction == 0.0) return lo <= origin && origin <= hi;
    const double to_lo = (lo - origin) / direction, to_hi = (hi - origin) / direction;
    const bool forward = direction > 0.0;
    const Crossing in{forward ? to_lo : to_hi, forward ? lower : lower + 1};
    const Crossing out{forward ? to_hi : to_lo, forward ? lower + 1 : lower};
    // A denormal direction makes these infinite, or 0/denormal = 0 on the plane itself: never NaN.
    if (in.t > span.in.t) span.in = in;
    if (out.t < span.out.t) span.out = out;
    return span.in.t <= span.out.t;
  }

  Box box_;
};

}  // namespace raycast
