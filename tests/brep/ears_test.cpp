// SPDX-License-Identifier: MIT
// ears: the triangles of a simple polygon turn as it does, have its area, and cover each of its points once.

#include <brep/ears.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/polygon.hpp>

#include "outlines.hpp"
#include "shapes.hpp"

using outlines::Points;
using shapes::Random;

namespace {

// Every edge gets up to two corners between its ends.
Points with_straight_corners(const Points& outline, Random& random) {
  Points p;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    p.push_back(a);
    const unsigned more = random.below(3);
    for (unsigned k = 1; k <= more; ++k) { p.push_back(a + (b - a) * (k / (more + 1.0))); }
  }
  return p;
}

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool inside(const Points& outline, glm::dvec2 p) {  // by crossings of a ray along x
  bool odd = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) { odd = !odd; }
  }
  return odd;
}

void check(const Points& outline, Random& random) {
  // Placed anywhere in space; the frame is orthogonal, so areas stay.
  const glm::dvec3 z = glm::normalize(glm::dvec3{random.unit() - 0.5, random.unit() - 0.5, 0.1 + random.unit()});
  const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3{0.3, 1.0, 0.2}, z)), y = glm::cross(z, x);
  std::vector<glm::dvec3> corners;
  for (const glm::dvec2& p : outline) { corners.push_back(p.x * x + p.y * y + 3.0 * z); }

  const auto triangles = brep::ears(corners);
  CHECK(triangles.size() == outline.size() - 2);
  const double whole = glm::length(brep::vector_area(corners));
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double area = 0.5 * glm::dot(glm::cross(corners[b] - corners[a], corners[c] - corners[a]), z);
    CHECK(area >= -1e-13 * whole);  // rounding of straight corners
    sum += area;
  }
  CHECK(sum == test::Approx(whole).epsilon(1e-12));

  glm::dvec2 low = outline[0], high = outline[0];
  for (const glm::dvec2& p : outline) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  unsigned wrong = 0;  // borders have no area: no random point is expected on one
  for (int k = 0; k < 200; ++k) {
    const glm::dvec2 p = low + (high - low) * glm::dvec2{random.unit(), random.unit()};
    unsigned covered = 0;
    for (const auto& [a, b, c] : triangles) {
      const glm::dvec2 &u = outline[a], &v = outline[b], &w = outline[c];
      covered += turn(u, v, p) > 0.0 && turn(v, w, p) > 0.0 && turn(w, u, p) > 0.0;
    }
    wrong += covered != (inside(outline, p) ? 1U : 0U);
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("the ears of a simple polygon cover each of its points once", "[ears]") {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    for (const Points& outline : {outlines::star_shaped(seed), outlines::rectilinear(seed), outlines::comb(2 + seed % 7),
                                  outlines::star(3 + seed % 9, 0.2 + 0.5 * random.unit())}) {
      check(outline, random);
      check(with_straight_corners(outline, random), random);
    }
  }
}

TEST_CASE("a quadrilateral that is bent is cut along the diagonal that leaves the better triangles", "[ears]") {
  // The short diagonal of a kite leaves two triangles of better shape than the long one.
  const std::vector<glm::dvec3> kite{{0, 0, 0}, {3, -0.5, 0.1}, {6, 0, 0}, {3, 0.5, 0.1}};
  for (const auto& triangle : brep::ears(kite)) {
    unsigned on_short = 0;
    for (const std::uint32_t corner : triangle) { on_short += corner % 2 == 1; }
    CHECK(on_short == 2);
  }
}
