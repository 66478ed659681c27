// SPDX-License-Identifier: MIT
#pragma once

// Axis-aligned bounds, and the slab test of a line against them.
//
// The slab test must never miss a box that the line meets (Ize 2013, "Robust BVH Ray Traversal"). Each slab parameter is a product of a
// rounded difference and a rounded reciprocal, so it is exact up to a factor 1 +- 3u/(1-3u); entry and exit are therefore compared with a
// relative slack of eps_slab. A direction component of +-0 gives +-inf, and 0 * inf = NaN if the origin lies on the slab's plane;
// comparisons are written so that a NaN leaves the interval unchanged, so the plane counts as inside.

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/ray.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

struct Box {
  glm::dvec3 lo{infinity}, hi{-infinity};  // the default is the empty box

  [[nodiscard]] bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  [[nodiscard]] glm::dvec3 centre() const { return 0.5 * lo + 0.5 * hi; }
  [[nodiscard]] glm::dvec3 size() const { return empty() ? glm::dvec3{0.0} : hi - lo; }
  [[nodiscard]] double diameter() const { return glm::length(size()); }
  // Corner 0 to 7; bit k of the index: at the upper end along axis k.
  [[nodiscard]] glm::dvec3 corner(unsigned index) const {
    return {index & 1u ? hi.x : lo.x, index & 2u ? hi.y : lo.y, index & 4u ? hi.z : lo.z};
  }
  [[nodiscard]] double half_area() const {
    const glm::dvec3 s = size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
  }
  // The largest absolute coordinate, to which rounding errors of positions are relative.
  [[nodiscard]] double magnitude() const {
    double m = 0.0;
    if (!empty()) {
      for (int k = 0; k < 3; ++k) { m = std::max({m, std::abs(lo[k]), std::abs(hi[k])}); }
    }
    return m;
  }
  [[nodiscard]] bool contains(const glm::dvec3& p, double margin = 0.0) const {
    return p.x >= lo.x - margin && p.x <= hi.x + margin && p.y >= lo.y - margin && p.y <= hi.y + margin && p.z >= lo.z - margin &&
           p.z <= hi.z + margin;
  }
  [[nodiscard]] bool contains(const Box& b) const {
    return lo.x <= b.lo.x && lo.y <= b.lo.y && lo.z <= b.lo.z && b.hi.x <= hi.x && b.hi.y <= hi.y && b.hi.z <= hi.z;
  }
  // Do they have a point in common, or come as close to each other as `margin` along every axis?
  [[nodiscard]] bool meets(const Box& b, double margin = 0.0) const {
    return lo.x - margin <= b.hi.x && b.lo.x - margin <= hi.x && lo.y - margin <= b.hi.y && b.lo.y - margin <= hi.y &&
           lo.z - margin <= b.hi.z && b.lo.z - margin <= hi.z;
  }
  void extend(const glm::dvec3& p) {
    lo = glm::dvec3{std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = glm::dvec3{std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  void extend(const Box& b) {
    lo = glm::dvec3{std::min(lo.x, b.lo.x), std::min(lo.y, b.lo.y), std::min(lo.z, b.lo.z)};
    hi = glm::dvec3{std::max(hi.x, b.hi.x), std::max(hi.y, b.hi.y), std::max(hi.z, b.hi.z)};
  }
  [[nodiscard]] Box grown(double margin) const { return empty() ? *this : Box{lo - margin, hi + margin}; }
};

// A line, prepared for many slab tests.
class SlabTest {
 public:
  explicit SlabTest(const Segment& line)
      : origin_(line.origin), inverse_(1.0 / line.direction.x, 1.0 / line.direction.y, 1.0 / line.direction.z) {
    // Taken from the reciprocal, not from the direction, because -0.0 must choose the side that its -inf belongs to.
    for (int k = 0; k < 3; ++k) { backward_[k] = std::signbit(inverse_[k]); }
  }

  // Does the line meet the box within [t0, t1]? If so, `entry` is set to the (rounded) parameter of the entry, at least t0.
  [[nodiscard]] bool operator()(const Box& box, double t0, double t1, double& entry) const {
    double in = t0, out = t1;
    clip<0>(box, in, out);
    clip<1>(box, in, out);
    clip<2>(box, in, out);
    entry = in;
    if (!(in < infinity && out > -infinity)) { return false; }  // parallel to a slab, and outside of it
    return in <= out || in - out <= eps_slab * std::min(std::abs(in), std::abs(out));
  }

 private:
  // Cuts [in, out] to the slab of the box along axis k.
  template <int k>
  void clip(const Box& box, double& in, double& out) const {
    const double near = ((backward_[k] ? box.hi : box.lo)[k] - origin_[k]) * inverse_[k];
    const double far = ((backward_[k] ? box.lo : box.hi)[k] - origin_[k]) * inverse_[k];
    in = near > in ? near : in;  // false for NaN, which leaves `in` unchanged
    out = far < out ? far : out;
  }

  glm::dvec3 origin_{0.0}, inverse_{0.0};
  bool backward_[3] = {};
};

}  // namespace raycast
