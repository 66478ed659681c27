// SPDX-License-Identifier: MIT
#include <raycast/circle.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>

namespace raycast {

HALFLIGHT_INLINE AxisFrame::AxisFrame(const glm::dvec3& axis) : w(glm::normalize(axis)) {
  int smallest = 0;  // the coordinate axis most nearly perpendicular to w
  for (int k = 1; k < 3; ++k) {
    if (std::abs(w[k]) < std::abs(w[smallest])) { smallest = k; }
  }
  glm::dvec3 across{0.0};
  across[smallest] = 1.0;
  v = glm::normalize(glm::cross(w, across));
  u = glm::normalize(glm::cross(v, w));
}

HALFLIGHT_INLINE void AxisFrame::extend(Box& box, const glm::dvec3& centre, double radius) const {
  glm::dvec3 reach{0.0};
  for (int k = 0; k < 3; ++k) { reach[k] = radius * std::sqrt(u[k] * u[k] + v[k] * v[k]); }
  box.extend(centre - reach);
  box.extend(centre + reach);
}

HALFLIGHT_INLINE glm::dvec2 circle_point(int i, int n) {
  const double angle = 2 * std::numbers::pi * (i % (n / 4)) / n;
  double x = std::cos(angle), y = std::sin(angle);
  for (int quarter = i / (n / 4) % 4; quarter > 0; --quarter) { x = -std::exchange(y, x); }
  return {x, y};
}

HALFLIGHT_INLINE int circle_points(double error) {
  constexpr int most = 1024;
  if (!(error > 0.0)) { return most; }
  int n = 8;
  while (n < most && 1.0 - std::cos(std::numbers::pi / n) > error) { n += 4; }
  return n;
}

HALFLIGHT_INLINE int rows_along(double length, double width, double radius, double tolerance) {
  const double size = std::hypot(length, 2.0 * std::numbers::sqrt2 * radius);
  const double of_sphere = std::sqrt(4.0 * std::numbers::inv_sqrt3 * size * tolerance);
  return static_cast<int>(std::clamp(std::round(length / std::max(width, of_sphere)), 1.0, 64.0));
}

}  // namespace raycast
