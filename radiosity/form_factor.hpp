// SPDX-License-Identifier: MIT
#pragma once

// Form factors without occlusion.
//
//   disk_estimate     point to disk of equal area, the paper's formula (section 4.3): cheap, never above 1,
//                     right far away. The oracle asks it.
//   point_to_polygon  Lambert's contour (Lambert 1760): exact for any planar polygon above the horizon.
//   clip_to_horizon   the part of a polygon above a plane; light never comes from below it.
//
// The exchange between two patches stands in exchange.hpp. Polygons are counter-clockwise seen from their
// bright side, of any number of corners.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace radiosity {

using Polygon = std::vector<glm::dvec3>;

// F from a point (normal n) to a patch of area `area` with centre c and normal m, both normals of length 1.
// Paper 4.3: F = cos_i cos_j A / (pi r^2 + A). 0 when either faces away.
[[nodiscard]] inline double disk_estimate(const glm::dvec3& point, const glm::dvec3& n, const glm::dvec3& c, const glm::dvec3& m,
                                          double area) {
  const glm::dvec3 d = c - point;
  const double r2 = glm::dot(d, d);
  const double cosines = glm::dot(n, d) * -glm::dot(m, d);  // both cosines times r^2
  if (!(cosines > 0.0) || !(glm::dot(n, d) > 0.0)) { return 0.0; }
  return cosines / r2 * area / (std::numbers::pi * r2 + area);
}

// Appends to `out` the part of `polygon` on or above the plane through p with normal n.
// Sutherland-Hodgman (1974): a convex polygon stays convex; corners exactly on the plane are kept.
inline void clip_to_horizon(std::span<const glm::dvec3> polygon, const glm::dvec3& p, const glm::dvec3& n, Polygon& out) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(n, a - p);
    const double db = glm::dot(n, b - p);
    if (da >= 0.0) { out.push_back(a); }
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) { out.push_back(a + (b - a) * (da / (da - db))); }
  }
}

// F from the point x with unit normal n to the polygon, which must lie above the horizon of x and turn its
// bright side to x. Error: a few ulp of 1, also when x lies on the polygon's edge or plane. atan2 alone keeps
// this accuracy for edges that subtend more than a right angle.
[[nodiscard]] inline double point_to_polygon(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - x;
    const glm::dvec3 b = polygon[(i + 1) % polygon.size()] - x;
    const glm::dvec3 cross = glm::cross(b, a);  // the contour runs counter-clockwise seen from x
    const double sine = glm::length(cross);
    if (sine > 0.0) { sum += glm::dot(n, cross) / sine * std::atan2(sine, glm::dot(a, b)); }
  }
  return std::max(0.0, sum / (2.0 * std::numbers::pi));
}

}  // namespace radiosity
