// SPDX-License-Identifier: MIT
#include <radiosity/geometry/chord.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::optional<ChordPoint> chord_point(const ChordTriangle& triangle, const glm::dvec3& x) {
  const auto& [a, b, c] = triangle.position;
  const auto& [na, nb, nc] = triangle.normal;
  const glm::dvec3 db = nb - na;
  const glm::dvec3 dc = nc - na;
  const double size = std::max(glm::length(b - a), glm::length(c - a));
  double s = 0.0;
  bool found = false;
  for (int round = 0; round < 12; ++round) {
    const glm::dvec3 from_a = x - a - s * na;
    const glm::dvec3 ab = b - a + s * db;
    const glm::dvec3 ac = c - a + s * dc;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double squared = glm::dot(normal, normal);
    if (!(squared > 0.0)) { return std::nullopt; }
    if (found) {
      const double wb = glm::dot(glm::cross(from_a, ac), normal) / squared;
      const double wc = glm::dot(glm::cross(ab, from_a), normal) / squared;
      return ChordPoint{{1.0 - wb - wc, wb, wc}, s};
    }
    const double slope = glm::dot(from_a, glm::cross(db, ac) + glm::cross(ab, dc)) - glm::dot(na, normal);
    const double step = -glm::dot(from_a, normal) / slope;
    if (!std::isfinite(step)) { return std::nullopt; }
    s += step;
    found = std::abs(step) <= 1e-9 * size;  // Newton converges quadratically: the remaining error is about the square of the step
  }
  return std::nullopt;
}

HALFLIGHT_INLINE glm::dvec3 nearest_in_triangle(const std::array<glm::dvec3, 3>& p, const glm::dvec3& x) {
  const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double squared = glm::dot(normal, normal);
  if (squared > 0.0) {
    const double wb = glm::dot(glm::cross(x - p[0], p[2] - p[0]), normal) / squared;
    const double wc = glm::dot(glm::cross(p[1] - p[0], x - p[0]), normal) / squared;
    if (wb >= 0.0 && wc >= 0.0 && wb + wc <= 1.0) { return {1.0 - wb - wc, wb, wc}; }
  }
  glm::dvec3 best{1.0, 0.0, 0.0};
  double best_squared = -1.0;
  for (int i = 0; i < 3; ++i) {  // outside: the nearest point lies on the boundary
    const int j = (i + 1) % 3;
    const glm::dvec3& from = p[static_cast<std::size_t>(i)];
    const glm::dvec3 edge = p[static_cast<std::size_t>(j)] - from;
    const double length = glm::dot(edge, edge);
    const double t = length > 0.0 ? std::clamp(glm::dot(x - from, edge) / length, 0.0, 1.0) : 0.0;
    const glm::dvec3 gap = x - from - t * edge;
    if (best_squared >= 0.0 && !(glm::dot(gap, gap) < best_squared)) { continue; }
    best_squared = glm::dot(gap, gap);
    best = glm::dvec3{0.0};
    best[i] = 1.0 - t;
    best[j] = t;
  }
  return best;
}

}  // namespace radiosity
