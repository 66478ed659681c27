// SPDX-License-Identifier: MIT
#pragma once

// What polygon.hpp, mesh.hpp and scene.hpp share about planar polygons: the checks of an input polygon, its plane, and the test whether
// a line passes through it.
//
// The line test is watertight (after Woop, Benthin, Wald 2013): the corners are projected along the ray, each by an expression that
// depends on the corner and the ray only, and the winding number of the projected outline about the ray is counted by its edges.
// An edge's contribution is computed from its lower end to its upper end whichever way the polygon runs along it, so two faces that
// share an edge see contributions that cancel exactly. Hence the winding numbers of the faces of a closed mesh add up to zero for every
// line, through edges and vertices too: a line that gets in gets out.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/ray.hpp>

namespace raycast {

// A right-handed projection along a line: x, y of a point relative to the line, scaled by the direction's largest component.
class RayFrame {
 public:
  explicit RayFrame(const Segment& line);

  // How often the closed outline runs around the line, counted so that +1 is a line that leaves through the polygon's front (it runs
  // along the polygon's normal) and -1 one that meets the front. 0: the line passes beside it.
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
      w += static_cast<int>(straddles && side > 0.0) * (up ? 1 : -1);  // the edge passes on the positive x side
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

// The mean plane of a polygon: Newell's normal; through the first corner when the corners are planar up to rounding, otherwise through
// the height of their mean. `slack` is the largest distance of a corner from it, 0 when planar up to rounding (16 u of the magnitude).
struct Plane {
  glm::dvec3 point{0.0}, normal{0.0};
  double slack = 0.0;
};

[[nodiscard]] Plane plane_of(std::span<const glm::dvec3> corners);

namespace detail {

using Flat = std::array<double, 2>;  // a corner without the coordinate in which the polygon is thinnest

// +1: c lies left of a -> b; 0: on it within the rounding of the determinant.
int side_of(const Flat& a, const Flat& b, const Flat& c);
inline bool within(const Flat& a, const Flat& b, const Flat& p) {
  return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}
bool meet(const Flat& a, const Flat& b, const Flat& c, const Flat& d);

}  // namespace detail

// Why this is no planar simple polygon with an area, in words that follow "the polygon " / "face 7 "; nothing when it is one.
// Straight corners are allowed. Corners may leave the mean plane by planar_tolerance() of the polygon. O(n^2) for n corners.
// `rounding`: the largest error of a coordinate as it was written, in its own unit, such as half a unit of its last digit.
[[nodiscard]] std::optional<std::string> polygon_fault(std::span<const glm::dvec3> corners, double rounding = 0.0);

// How far a corner may lie off the mean plane: 1e-6 of the polygon's extent, and what rounding does. Rounding moves a corner by at most
// sqrt(3) `rounding`, and the mean plane by no more than that; it counts up to 1e-4 of the extent.
[[nodiscard]] double planar_tolerance(std::span<const glm::dvec3> corners, double rounding);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/planar.cpp>
#endif
