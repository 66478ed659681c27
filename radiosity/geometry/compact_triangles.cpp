// SPDX-License-Identifier: MIT
#include <radiosity/geometry/compact_triangles.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/support/draw.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE std::vector<std::array<glm::dvec3, 3>> compact_triangles(const std::vector<Polygon>& faces) {
  std::vector<std::array<glm::dvec3, 3>> pieces;
  for (const Polygon& face : faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) { pieces.push_back({face[0], face[i], face[i + 1]}); }
  }
  const std::size_t most = std::max<std::size_t>(4096, 2 * pieces.size());
  for (std::size_t k = 0; k < pieces.size() && pieces.size() < most;) {
    auto& [a, b, c] = pieces[k];
    const double ab = glm::length(b - a), bc = glm::length(c - b), ca = glm::length(a - c);
    const double longest = std::max({ab, bc, ca});
    const double area = triangle_area(a, b, c);
    if (!(area > 0.0) || longest * longest <= 8.0 * area) {  // this ratio is 4 for an isosceles right triangle
      ++k;
      continue;
    }
    while (glm::length(b - a) < longest) {  // rotate until a b is the longest side
      const glm::dvec3 first = a;
      a = b;
      b = c;
      c = first;
    }
    const glm::dvec3 middle = 0.5 * (a + b);
    const std::array<glm::dvec3, 3> rest{middle, b, c};
    b = middle;
    pieces.push_back(rest);
  }
  return pieces;
}

}  // namespace detail

}  // namespace radiosity
