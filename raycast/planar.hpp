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

#include <brep/geometry.hpp>

#include "box.hpp"
#include "object.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace raycast {

// A right-handed projection along a line: x, y of a point relative to the line, scaled by the direction's largest component.
class RayFrame {
 public:
  explicit RayFrame(const Segment& line) : origin_(line.origin) {
    const glm::dvec3& d = line.direction;
    const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
    if (az >= ax && az >= ay) {
      x_ = {d.z, 0.0, -d.x}, y_ = {0.0, d.z, -d.y}, forward_ = d.z > 0.0;
    } else if (ax >= ay) {
      x_ = {-d.y, d.x, 0.0}, y_ = {-d.z, 0.0, d.x}, forward_ = d.x > 0.0;
    } else {
      x_ = {0.0, -d.z, d.y}, y_ = {d.y, -d.x, 0.0}, forward_ = d.y > 0.0;
    }
  }

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

[[nodiscard]] inline Plane plane_of(std::span<const glm::dvec3> corners) {
  Plane plane{corners[0], brep::normal(corners), 0.0};
  double mean = 0.0, lowest = 0.0, highest = 0.0, magnitude = 0.0;
  for (const glm::dvec3& p : corners) {
    const double height = glm::dot(p - corners[0], plane.normal);
    mean += height / static_cast<double>(corners.size());
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
    magnitude = std::max(magnitude, Box{p, p}.magnitude());
  }
  if (highest - lowest > 16 * unit_roundoff * magnitude) {
    plane.point += mean * plane.normal;
    plane.slack = std::max(highest - mean, mean - lowest);
  }
  return plane;
}

namespace detail {

using Flat = std::array<double, 2>;  // a corner without the coordinate in which the polygon is thinnest

// +1: c lies left of a -> b; 0: on it within the rounding of the determinant.
inline int side_of(const Flat& a, const Flat& b, const Flat& c) {
  const double l = (b[0] - a[0]) * (c[1] - a[1]), r = (b[1] - a[1]) * (c[0] - a[0]);
  const double error = 4 * unit_roundoff * (std::abs(l) + std::abs(r));
  return l - r > error ? 1 : l - r < -error ? -1 : 0;
}
inline bool within(const Flat& a, const Flat& b, const Flat& p) {
  return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}
inline bool meet(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
  for (std::size_t k = 0; k < 2; ++k)
    if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k])) return false;
  const int abc = side_of(a, b, c), abd = side_of(a, b, d), cda = side_of(c, d, a), cdb = side_of(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) || (cda == 0 && within(c, d, a)) || (cdb == 0 && within(c, d, b));
}

}  // namespace detail

// Why this is no planar simple polygon with an area, in words that follow "the polygon " / "face 7 "; nothing when it is one.
// Straight corners are allowed. Corners may leave the mean plane by 1e-6 of the polygon's extent. O(n^2) for n corners.
[[nodiscard]] inline std::optional<std::string> polygon_fault(std::span<const glm::dvec3> corners) {
  const std::size_t n = corners.size();
  const auto name = [](std::size_t i) { return std::to_string(i + 1); };  // people count from one
  if (n < 3) return "has " + std::to_string(n) + " corners; it needs at least 3";
  for (std::size_t i = 0; i < n; ++i)
    if (!usable(corners[i])) return "has a corner (number " + name(i) + ") that is not finite (or beyond 1e60)";
  Box box;
  for (const glm::dvec3& p : corners) box.extend(p);
  const double extent = brep::extent(corners);
  if (!usable_length(extent, box.magnitude())) return "has no size (all corners coincide, compared with their coordinates)";
  for (std::size_t i = 0; i < n; ++i)
    if (corners[i] == corners[(i + 1) % n])
      return "has two equal corners in succession (numbers " + name(i) + " and " + name((i + 1) % n) + ")";
  const glm::dvec3 area = brep::vector_area(corners);
  if (!(glm::length(area) > 1e-12 * extent * extent)) return "has no area: its corners lie on a line, or it crosses itself";
  const Plane plane = plane_of(corners);
  if (plane.slack > 1e-6 * extent + 16 * unit_roundoff * box.magnitude()) {
    std::size_t worst = 0;
    const auto height = [&](std::size_t i) { return std::abs(glm::dot(corners[i] - plane.point, plane.normal)); };
    for (std::size_t i = 1; i < n; ++i)
      if (height(i) > height(worst)) worst = i;
    return "is not planar: corner " + name(worst) + " lies " + std::to_string(height(worst) / extent) +
           " of the polygon's extent off its plane (1e-6 is allowed)";
  }
  if (n == 3) return std::nullopt;
  int drop = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(area[k]) > std::abs(area[drop])) drop = k;
  const auto flat = [&](std::size_t i) { return detail::Flat{corners[i][(drop + 1) % 3], corners[i][(drop + 2) % 3]}; };
  for (std::size_t i = 0; i < n; ++i) {
    const detail::Flat a = flat(i), b = flat((i + 1) % n), c = flat((i + 2) % n);
    if (detail::side_of(a, b, c) == 0 && (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0.0)
      return "turns back on itself at corner " + name((i + 1) % n);
    for (std::size_t j = i + 2; j < n; ++j)
      if (!(i == 0 && j == n - 1) && detail::meet(a, b, flat(j), flat((j + 1) % n)))
        return "intersects itself: edge " + name(i) + " meets edge " + name(j);
  }
  return std::nullopt;
}

}  // namespace raycast
