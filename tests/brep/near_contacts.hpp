// SPDX-License-Identifier: MIT
#pragma once

// Outlines that come within rounding of themselves: 1e-9 to 1e-17 of their size before a contact, at it, or a rounding beyond.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "outlines.hpp"
#include "shapes.hpp"

namespace near_contacts {

using outlines::Points;
using shapes::Random;

inline double gap(Random& random) {
  const unsigned kind = random.below(4);
  return kind == 0 ? 0.0 : kind == 1 ? (random.below(2) == 0 ? -0x1p-53 : 0x1p-53) : std::pow(10.0, -9.0 - 8.0 * random.unit());
}

// A square with a notch that reaches the opposite side.
inline Points notch(Random& random) {
  const double x = 0.2 + 0.6 * random.unit(), half = 0.02 + 0.1 * random.unit();
  return {{0, 0}, {1, 0}, {1, 1}, {x + half, 1}, {x + 0.2 * (random.unit() - 0.5), gap(random)}, {x - half, 1}, {0, 1}};
}
// A square with a slit.
inline Points slit(Random& random) {
  const double x = 0.2 + 0.6 * random.unit(), y = 0.9 * random.unit(), width = std::abs(gap(random));
  Points p{{0, 0}, {1, 0}, {1, 1}, {x + width, 1}, {x + width, y}};
  if (random.below(2) == 0) { p.push_back({x, y}); }
  p.insert(p.end(), {{x, 1}, {0, 1}});
  return p;
}
// A square with two notches whose tips meet.
inline Points two_notches(Random& random) {
  const double y = 0.3 + 0.4 * random.unit(), aside = random.below(2) == 0 ? 0.0 : gap(random);
  return {{0, 0}, {0.45, 0}, {0.5, y}, {0.55, 0}, {1, 0}, {1, 1}, {0.55, 1}, {0.5 + aside, y + gap(random)}, {0.45, 1}, {0, 1}};
}
// A spiral of which the outer half of the wall has no width.
inline Points spiral(Random& random) {
  const unsigned n = 12 * (1 + random.below(4));
  const double width = std::abs(gap(random));
  Points p;
  const auto add = [&](unsigned i, double inward) {
    const double angle = 2.0 * shapes::pi * i / 12, r = 1.0 + 0.5 * i - inward;
    p.push_back({r * std::cos(angle), r * std::sin(angle)});
  };
  for (unsigned i = 0; i <= n; ++i) { add(i, 0.0); }
  for (unsigned i = n + 1; i-- > 0;) { add(i, i < n / 2 ? 0.2 : width); }
  return p;
}
// Triangles of a grid, joined along the edges of a tree: on all other edges the outline runs along itself.
inline Points joined_triangles(Random& random) {
  const unsigned m = 2 + random.below(5);
  std::vector<glm::dvec2> grid;
  for (unsigned y = 0; y <= m; ++y) {
    for (unsigned x = 0; x <= m; ++x) { grid.push_back({x + 0.3 * (random.unit() - 0.5), y + 0.3 * (random.unit() - 0.5)}); }
  }
  std::vector<std::array<unsigned, 3>> left;
  for (unsigned y = 0; y < m; ++y) {
    for (unsigned x = 0; x < m; ++x) {
      const unsigned a = y * (m + 1) + x, b = a + 1, c = a + m + 1, d = c + 1;
      left.push_back({a, b, d});
      left.push_back({a, d, c});
    }
  }
  const unsigned first = random.below(static_cast<unsigned>(left.size())), keep = random.below(static_cast<unsigned>(left.size()));
  std::vector<unsigned> loop(left[first].begin(), left[first].end());
  left.erase(left.begin() + first);
  for (int attempt = 0; attempt < 4000 && left.size() > keep; ++attempt) {
    const std::size_t i = random.below(static_cast<unsigned>(loop.size()));
    const unsigned a = loop[i], b = loop[(i + 1) % loop.size()];
    for (std::size_t k = 0; k < left.size(); ++k) {
      std::size_t e = 0;
      while (e < 3 && !(left[k][e] == b && left[k][(e + 1) % 3] == a)) { ++e; }
      if (e == 3) { continue; }
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, left[k][(e + 2) % 3]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
      break;
    }
  }
  const double shift = random.below(3) == 0 ? 0.0 : std::pow(10.0, -9.0 - 8.0 * random.unit());
  Points p;
  for (const unsigned i : loop) { p.push_back(grid[i] + shift * glm::dvec2{random.unit() - 0.5, random.unit() - 0.5}); }
  return p;
}

// One of them, turned and scaled two times in three.
inline std::vector<glm::dvec3> outline(Random& random) {
  Points p;
  switch (random.below(5)) {
    case 0:
      p = notch(random);
      break;
    case 1:
      p = slit(random);
      break;
    case 2:
      p = two_notches(random);
      break;
    case 3:
      p = spiral(random);
      break;
    default:
      p = joined_triangles(random);
  }
  glm::dvec3 x{1, 0, 0}, y{0, 1, 0};
  if (random.below(3) > 0) {
    const auto direction = [&] { return glm::normalize(glm::dvec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() + 0.1}); };
    const double scale = std::pow(10.0, 4.0 * random.unit() - 2.0);
    const glm::dvec3 u = direction();
    const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3{0.3, 1.0, -0.2}));
    x = scale * u, y = scale * v;
  }
  std::vector<glm::dvec3> points;
  for (const glm::dvec2& q : p) { points.push_back(q.x * x + q.y * y); }
  return points;
}

}  // namespace near_contacts
