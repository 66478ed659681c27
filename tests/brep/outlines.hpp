// SPDX-License-Identifier: MIT
#pragma once

// Planar polygons to be taken apart, and what is asked of the parts.

#include <algorithm>
#include <cmath>
#include <vector>

#include <brep/split.hpp>

#include "shapes.hpp"

namespace outlines {

using Points = std::vector<glm::dvec2>;

inline Points comb(unsigned teeth) {
  Points p{{0, 0}, {2.0 * teeth - 1.0, 0}};
  for (unsigned i = teeth; i-- > 0;) {
    const double x = 2.0 * i;
    p.insert(p.end(), {{x + 1.0, 3.0}, {x, 3.0}});
    if (i > 0) { p.insert(p.end(), {{x, 1.0}, {x - 1.0, 1.0}}); }
  }
  return p;
}
inline Points star(unsigned points, double inner) {
  Points p;
  for (unsigned i = 0; i < 2 * points; ++i) {
    const double r = i % 2 == 0 ? 1.0 : inner, angle = shapes::pi * i / points;
    p.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return p;
}
inline Points spiral(unsigned turns) {
  const unsigned n = 12 * turns;
  Points p;
  for (unsigned i = 0; i <= n; ++i) {  // outward along the outer wall, back along the inner one
    const double a = 2.0 * shapes::pi * i / 12, r = 1.0 + 0.5 * i;
    p.push_back({r * std::cos(a), r * std::sin(a)});
  }
  for (unsigned i = n + 1; i-- > 0;) {
    const double a = 2.0 * shapes::pi * i / 12, r = 1.0 + 0.5 * i - 2.0 * std::min(1.0, 0.2 + 0.05 * i);
    p.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return p;
}

inline Points star_shaped(std::uint32_t seed) {
  shapes::Random random(seed);
  const unsigned n = 4 + random.below(40);
  Points p;
  for (unsigned i = 0; i < n; ++i) {
    const double a = 2.0 * shapes::pi * (i + 0.8 * random.unit()) / n, r = 0.1 + random.unit();
    p.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return p;
}

// Staircases on all sides: only right angles, about half of the corners non-convex.
inline Points rectilinear(std::uint32_t seed) {
  shapes::Random random(seed);
  Points p;
  const unsigned n = 2 + random.below(12);
  double x = 0.0;
  for (unsigned i = 0; i < n; ++i) {  // below, from left to right
    const double y = -0.5 - random.unit();
    p.push_back({x, y});
    x += 0.1 + random.unit();
    p.push_back({x, y});
  }
  for (unsigned i = 0; i < n; ++i) {  // above, from right to left; the strip between is free
    const double y = 0.5 + random.unit();
    p.push_back({x, y});
    x = i + 1 < n ? x * (0.4 + 0.5 * random.unit()) : 0.0;
    p.push_back({x, y});
  }
  return p;
}

// The parts cover the face: their areas, all positive along its normal, add up to the face's.
inline void check_cover(const shapes::Mesh& m, const std::vector<brep::FaceId>& parts, double whole, const glm::dvec3& n) {
  double sum = 0.0;
  for (brep::FaceId f : parts) {
    CHECK(glm::dot(vector_area(m, f), n) > 0.0);
    sum += area(m, f);
  }
  CHECK(sum == test::Approx(whole).epsilon(1e-12));
}

}  // namespace outlines
