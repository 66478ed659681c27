// SPDX-License-Identifier: MIT
#pragma once

// The torus of the files in tests/data/draco and tests/data/meshopt: n x n quads, each cut in two, with windows.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <glm/vec3.hpp>

namespace torus {

using Place = std::array<int, 2>;  // in the grid; n is the same place as 0
using Triangle = std::array<Place, 3>;

inline glm::dvec3 position(int n, Place place) {
  const double u = 2.0 * std::numbers::pi * place[0] / n, v = 2.0 * std::numbers::pi * place[1] / n;
  return {(2.0 + std::cos(v)) * std::cos(u), (2.0 + std::cos(v)) * std::sin(u), std::sin(v)};
}

// The same triangle with its smallest corner first.
inline Triangle turned(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

// `wrapped`: places from 0 to n - 1, instead of n at the seams.
inline std::multiset<Triangle> triangles(int n, bool wrapped) {
  std::multiset<Triangle> out;
  const auto place = [&](int i, int j) { return wrapped ? Place{i % n, j % n} : Place{i, j}; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (3 * i < n && 3 * j < n && (i + j) % 2 == 1) { continue; }  // a window; some touch at their corners
      const Place a = place(i, j), b = place(i + 1, j), c = place(i + 1, j + 1), d = place(i, j + 1);
      out.insert(turned({a, b, c}));
      out.insert(turned({a, c, d}));
    }
  }
  return out;
}

}  // namespace torus
