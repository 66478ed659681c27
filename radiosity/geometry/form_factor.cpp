// SPDX-License-Identifier: MIT
#include <radiosity/geometry/form_factor.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

namespace radiosity {

HALFLIGHT_INLINE double disk_estimate(const glm::dvec3& point, const glm::dvec3& n, const glm::dvec3& c, const glm::dvec3& m, double area) {
  const glm::dvec3 d = c - point;
  const double r2 = glm::dot(d, d);
  const double cosines = glm::dot(n, d) * -glm::dot(m, d);  // both cosines times r^2
  if (!(cosines > 0.0) || !(glm::dot(n, d) > 0.0)) { return 0.0; }
  return cosines / r2 * area / (std::numbers::pi * r2 + area);
}

HALFLIGHT_INLINE void clip_to_horizon(std::span<const glm::dvec3> polygon, const glm::dvec3& p, const glm::dvec3& n, Polygon& out) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(n, a - p);
    const double db = glm::dot(n, b - p);
    if (da >= 0.0) { out.push_back(a); }
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) { out.push_back(a + (b - a) * (da / (da - db))); }
  }
}

HALFLIGHT_INLINE double point_to_polygon(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon) {
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

HALFLIGHT_INLINE glm::dvec3 light_vector(const glm::dvec3& x, std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - x;
    const glm::dvec3 b = polygon[(i + 1) % polygon.size()] - x;
    const glm::dvec3 cross = glm::cross(b, a);
    const double sine = glm::length(cross);
    if (sine > 0.0) { sum += std::atan2(sine, glm::dot(a, b)) / sine * cross; }
  }
  return sum / (2.0 * std::numbers::pi);
}

}  // namespace radiosity
