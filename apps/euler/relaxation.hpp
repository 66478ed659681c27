// SPDX-License-Identifier: MIT
#pragma once

// A triangulation in the plane, and the methods that bring its triangles close to their rest shapes without turning one over.
//
// See embedding.hpp, which makes the triangulation and its first drawing.

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

namespace apps::euler {

struct Link {
  std::uint32_t a, b;
  double weight;
};

struct Triangle {
  std::array<std::uint32_t, 3> corner;  // counter-clockwise
  glm::dmat2 rest;                      // inverse of the matrix of its edge vectors in its rest shape
  double pull;                          // the weight of its edges
};

// Points are numbered: vertices of the map first, then inner points of edges, rings, centres.
struct Net {
  std::vector<Triangle> triangles;
  std::vector<Link> links;
  std::vector<std::array<std::uint32_t, 3>> bends;  // three consecutive points on an edge
  std::vector<std::uint32_t> outer_ring;            // clockwise, as the walk around the outer face
  double rest_area = 0.0;
  std::uint32_t count = 0;
};

// Twice the signed area of a triangle: above 0 if a, b, c turn left, that is, if c lies to the left of the line from a to b.
[[nodiscard]] inline double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
[[nodiscard]] bool all_turn_left(const Net& net, const std::vector<glm::dvec2>& x);

// Enlarges parts that the weighted means have left tiny. Each point in turn moves to the minimum of the sum of |J|^2 - 2 log det(J) over
// its triangles, a convex function, by Newton's method. If all its triangles are tiny, only the ratios of their areas matter, so a part
// grows by a factor in each round, however small it is.
void unfold(const Net& net, double scale, const std::vector<bool>& fixed, std::vector<glm::dvec2>& x);

// Lowers the energy (L-BFGS, Nocedal 1980) from a drawing without crossings; no triangle turns over on the way.
void relax(const Net& net, double scale, const std::vector<bool>& fixed, std::vector<glm::dvec2>& x);

}  // namespace apps::euler
