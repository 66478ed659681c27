// SPDX-License-Identifier: MIT
#pragma once

// Common code of polygon.hpp, mesh.hpp and scene.hpp for planar polygons: validity of an input polygon, its plane, and the test whether a
// line passes through it.
//
// The line test is watertight (after Woop, Benthin, Wald 2013): the corners are projected along the ray, each by an expression that
// depends only on the corner and the ray, and the winding number of the projected outline about the ray is counted edge by edge. The
// contribution of an edge is computed from its lower to its upper end, whichever way the polygon runs along it, so the contributions of
// two faces that share an edge cancel exactly. Hence the winding numbers of the faces of a closed mesh add up to zero for every line,
// even through edges and vertices: a line that enters also leaves.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/ray.hpp>

namespace raycast {

// A right-handed projection along a line: x, y of a point relative to the line, scaled by the direction's largest component.
class RayFrame {
 public:
  explicit RayFrame(const Segment& line);

  // The winding number of the closed outline around the line: +1 if the line leaves through the polygon's front (runs along its normal),
  // -1 if it meets the front, 0 if it passes beside the polygon.
  template <class Corner>  // Corner(i) -> const glm::dvec3&
  [[nodiscard]] int winding(std::size_t count, Corner&& corner) const {
    int w = 0;
    glm::dvec3 r = corner(count - 1) - origin_;
    double xa = glm::dot(r, x_), ya = glm::dot(r, y_);
    for (std::size_t i = 0; i < count; ++i) {
      r = corner(i) - origin_;
      const double xb = glm::dot(r, x_), yb = glm::dot(r, y_);
      const bool up = ya < 0.0, straddles = up != (yb < 0.0);  // half-open: a corner at y = 0 counts as above
      const double side = (up ? xa : xb) * (up ? yb : ya) - (up ? xb : xa) * (up ? ya : yb);
      w += static_cast<int>(straddles && side > 0.0) * (up ? 1 : -1);  // does the edge pass on the positive x side?
      xa = xb;
      ya = yb;
    }
    return forward_ ? w : -w;
  }
  [[nodiscard]] int winding(std::span<const glm::dvec3> corners) const {
    return winding(corners.size(), [&](std::size_t i) -> const glm::dvec3& { return corners[i]; });
  }

 private:
  glm::dvec3 origin_{0.0}, x_{0.0}, y_{0.0};
  bool forward_ = true;
};

// The mean plane of a polygon with Newell's normal; through the first corner if the corners are planar up to rounding, otherwise through
// their mean height. `slack`: largest distance of a corner, 0 if planar up to rounding (16 u of the magnitude).
struct Plane {
  glm::dvec3 point{0.0}, normal{0.0};
  double slack = 0.0;
};

[[nodiscard]] Plane plane_of(std::span<const glm::dvec3> corners);

namespace detail {

using Flat = std::array<double, 2>;  // a corner without the coordinate along which the polygon is thinnest

// +1: c lies left of a -> b; 0: on the line within the rounding error of the determinant; -1: right.
int side_of(const Flat& a, const Flat& b, const Flat& c);
inline bool within(const Flat& a, const Flat& b, const Flat& p) {
  return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}
bool meet(const Flat& a, const Flat& b, const Flat& c, const Flat& d);

}  // namespace detail

// Why this is not a planar simple polygon with an area, in words that follow "the polygon " or "face 7 "; nothing if it is one. Straight
// corners are allowed. Corners may be off the mean plane by planar_tolerance(). O(n^2) for n corners. `rounding`: largest rounding error
// of a written coordinate, such as half a unit of its last digit.
[[nodiscard]] std::optional<std::string> polygon_fault(std::span<const glm::dvec3> corners, double rounding = 0.0);

// How far a corner may lie off the mean plane: 1e-6 of the polygon's extent plus the effect of rounding. Rounding moves a corner by at
// most sqrt(3) `rounding`, and the mean plane by no more than that; its effect is limited to 1e-4 of the extent.
[[nodiscard]] double planar_tolerance(std::span<const glm::dvec3> corners, double rounding);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/planar.cpp>
#endif
