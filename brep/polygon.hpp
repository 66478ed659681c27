// SPDX-License-Identifier: MIT
#pragma once

// Measures of polygons in space.
//
// A polygon is the list of its corners, counter-clockwise seen from the side to which its normal points. Nothing here needs it to be
// convex unless it says so. All sums are taken relative to the first corner, so a polygon far from the origin
// loses nothing beyond the rounding of its coordinates: for coordinates of size M and a polygon of diameter D the relative error of
// its area is of the order 2^-53 n M / D.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace brep {

using Polygon = std::span<const glm::dvec3>;

// Unit normal times area (Newell 1972: exact for planar polygons, the mean plane's for others). Zero below three corners.
[[nodiscard]] inline glm::dvec3 vector_area(Polygon p) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 2; i < p.size(); ++i) { sum += glm::cross(p[i - 1] - p[0], p[i] - p[0]); }
  return 0.5 * sum;
}

[[nodiscard]] inline double area(Polygon p) { return glm::length(vector_area(p)); }

// Unit normal; zero for a polygon without area.
[[nodiscard]] inline glm::dvec3 normal(Polygon p) {
  const glm::dvec3 a = vector_area(p);
  const double length = glm::length(a);
  return length > 0.0 ? a / length : glm::dvec3{0.0};
}

// Length of the diagonal of the box around the corners: between the diameter and sqrt(3) times the diameter.
[[nodiscard]] inline double extent(Polygon p) {
  if (p.empty()) { return 0.0; }
  glm::dvec3 lo = p[0], hi = p[0];
  for (const glm::dvec3& x : p) {
    lo = glm::min(lo, x);
    hi = glm::max(hi, x);
  }
  return glm::length(hi - lo);
}

// Centre of the area (not the mean of the corners); the mean of the corners for a polygon without area.
[[nodiscard]] inline glm::dvec3 centroid(Polygon p) {
  if (p.empty()) { return glm::dvec3{0.0}; }
  const glm::dvec3 n = vector_area(p);
  glm::dvec3 sum{0.0}, mean{0.0};
  double weight = 0.0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    mean += p[i] - p[0];
    if (i < 2) { continue; }
    const double w = glm::dot(glm::cross(p[i - 1] - p[0], p[i] - p[0]), n);
    weight += w;
    sum += w * ((p[i - 1] - p[0]) + (p[i] - p[0]));
  }
  const double size = extent(p);
  if (!(weight > 1e-24 * size * size * size * size)) { return p[0] + mean / static_cast<double>(p.size()); }
  return p[0] + sum / (3.0 * weight);
}

// Largest distance of a corner from the plane through the mean of the corners along the normal, relative to extent().
// 0 for a triangle, about 1e-16 for a planar polygon with exact coordinates.
[[nodiscard]] inline double planarity(Polygon p) {
  const double size = extent(p);
  if (p.size() < 4 || !(size > 0.0)) { return 0.0; }
  const glm::dvec3 n = normal(p);
  glm::dvec3 mean{0.0};
  for (const glm::dvec3& x : p) { mean += x - p[0]; }
  mean /= static_cast<double>(p.size());
  double distance = 0.0;
  for (const glm::dvec3& x : p) { distance = std::max(distance, std::abs(glm::dot(x - p[0] - mean, n))); }
  return distance / size;
}

// Does the planar polygon turn left everywhere, and once around altogether? Straight corners (T-vertices) and repeated points
// are allowed; a right turn counts from a sine of 1e-9 on. False without area.
[[nodiscard]] inline bool is_convex(Polygon p) {
  const glm::dvec3 n = normal(p);
  if (!(glm::dot(n, n) > 0.0)) { return false; }
  const std::size_t count = p.size();
  glm::dvec3 first{0.0}, before{0.0};
  double turning = 0.0;
  const auto turn = [&](const glm::dvec3& a, const glm::dvec3& b) {  // unit vectors; false: to the right, or back
    const double sine = glm::dot(glm::cross(a, b), n), cosine = glm::dot(a, b);
    turning += std::atan2(sine, cosine);
    return sine >= -1e-9 && (sine > 1e-9 || cosine > 0.0);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 side = p[(i + 1) % count] - p[i];
    const double length = glm::length(side);
    if (!(length > 0.0)) { continue; }
    const glm::dvec3 direction = side / length;
    if (before == glm::dvec3{0.0}) {
      first = direction;
    } else if (!turn(before, direction)) {
      return false;
    }
    before = direction;
  }
  return turn(before, first) && turning < 9.0;  // 2 pi for once around, 4 pi for a pentagram
}

}  // namespace brep
