// SPDX-License-Identifier: MIT
#pragma once

// Proportion of a mesh element: the radius of its largest inscribed circle over that of its smallest circumscribed circle
// (paper 4.4). Equilateral triangle 1/2, square 1/sqrt(2), regular n-gon cos(pi/n); towards 0 for slivers.
//
// For convex planar polygons. The inscribed circle is found by moving all sides inward at unit speed: a side of
// length s whose ends turn by a and b is gone after s / (tan a/2 + tan b/2), and the time when the last one goes is the radius
// (O(n^2)). The circumscribed circle is found by adding the corners one by one (Welzl 1991; O(n) expected). T-vertices on
// straight sides change neither.

#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <brep/outline.hpp>
#include <brep/polygon.hpp>

namespace brep {

namespace detail {

inline double cross2(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

struct Side {  // the half-plane  dot(normal, x) >= distance
  glm::dvec2 normal{0.0};
  double distance = 0.0;
};

// The time at which the three sides, moving along their normals at unit speed, meet in a point; infinite when they do not.
inline double meeting_time(const Side& a, const Side& b, const Side& c) {
  const glm::dvec2 ab = b.normal - a.normal, ac = c.normal - a.normal;
  const double det = cross2(ab, ac);
  if (!(std::abs(det) > 1e-14)) { return HUGE_VAL; }
  const double db = b.distance - a.distance, dc = c.distance - a.distance;  // dot(ab, x) = db, dot(ac, x) = dc
  const glm::dvec2 x{(db * ac.y - dc * ab.y) / det, (ab.x * dc - ac.x * db) / det};
  return glm::dot(a.normal, x) - a.distance;
}

inline double inscribed_radius(const Outline& p) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::dvec2 along = p[p.next(i)] - p[i];
    const double length = glm::length(along);
    if (!(length > 0.0)) { continue; }
    const glm::dvec2 n{-along.y / length, along.x / length};
    const Side side{n, glm::dot(n, p[i])};
    const auto straight = [&](const Side& other) { return std::abs(cross2(n, other.normal)) < 1e-10 && glm::dot(n, other.normal) > 0.0; };
    if (!sides.empty() && straight(sides.back())) { continue; }
    if (!sides.empty() && p.next(i) == 0 && straight(sides.front())) { continue; }
    sides.push_back(side);
  }
  if (sides.size() < 3) { return 0.0; }
  const auto time = [&](std::size_t i) {
    const std::size_t n = sides.size();
    return meeting_time(sides[(i + n - 1) % n], sides[i], sides[(i + 1) % n]);
  };
  while (sides.size() > 3) {
    std::size_t first = 0;
    double earliest = HUGE_VAL;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const double t = time(i);
      if (t < earliest) {
        earliest = t;
        first = i;
      }
    }
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return time(0);
}

struct Circle2 {
  glm::dvec2 centre{0.0};
  double radius = -1.0;
  [[nodiscard]] bool holds(const glm::dvec2& x) const { return glm::distance(centre, x) <= radius * (1.0 + 1e-12); }
};
inline Circle2 circle_through(const glm::dvec2& a, const glm::dvec2& b) { return {0.5 * (a + b), 0.5 * glm::distance(a, b)}; }
inline Circle2 circle_through(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const glm::dvec2 u = b - a, v = c - a;
  const double det = 2.0 * cross2(u, v);
  const glm::dvec2 m{(v.y * glm::dot(u, u) - u.y * glm::dot(v, v)) / det, (u.x * glm::dot(v, v) - v.x * glm::dot(u, u)) / det};
  return {a + m, glm::length(m)};
}

inline double circumscribed_radius(const Outline& p) {
  Circle2 circle;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (circle.holds(p[i])) { continue; }
    circle = {p[i], 0.0};
    for (std::size_t j = 0; j < i; ++j) {
      if (circle.holds(p[j])) { continue; }
      circle = circle_through(p[i], p[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (!circle.holds(p[k])) { circle = circle_through(p[i], p[j], p[k]); }
      }
    }
  }
  return circle.radius;
}

}  // namespace detail

// For a convex polygon; in [0, 1), relative error about 1e-10. 0 without area.
[[nodiscard]] inline double proportion(Polygon polygon) {
  if (!(area(polygon) > 0.0)) { return 0.0; }
  const Outline outline(polygon);
  double perimeter = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) { perimeter += glm::distance(outline[i], outline[outline.next(i)]); }
  // No circle within has a larger radius than twice the area over the perimeter, which is that of a triangle. The sides of a needle may be
  // too close to parallel to tell where they meet.
  const double radius = std::fmin(detail::inscribed_radius(outline), 2.0 * area(polygon) / perimeter);
  const double around = detail::circumscribed_radius(outline);
  return around > 0.0 && std::isfinite(around) ? std::fmax(0.0, radius) / around : 0.0;
}

}  // namespace brep
