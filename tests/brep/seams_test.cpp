// SPDX-License-Identifier: MIT
// join_holes: one polygon whose triangles cover the face and nothing of its holes.

#include <brep/seams.hpp>

#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/ears.hpp>
#include <brep/polygon.hpp>

#include "catch.hpp"

namespace {

using Loop = std::vector<glm::dvec3>;

// In the plane z = x; clockwise seen from above when it is a hole.
Loop square(double x, double y, double side, bool hole) {
  const Loop loop{{x, y, x}, {x + side, y, x + side}, {x + side, y + side, x + side}, {x, y + side, x}};
  return hole ? Loop(loop.rbegin(), loop.rend()) : loop;
}

double area(const Loop& loop) { return glm::length(brep::vector_area(loop)); }

double area_of_triangles(const Loop& polygon) {
  double sum = 0.0;
  for (const auto& [a, b, c] : brep::ears(polygon)) { sum += area({polygon[a], polygon[b], polygon[c]}); }
  return sum;
}

}  // namespace

TEST_CASE("join_holes: without holes the outline stays as it is") {
  const Loop outline = square(0.0, 0.0, 4.0, false);
  CHECK(brep::join_holes(outline, {}) == outline);
}

TEST_CASE("join_holes: each hole adds its corners and two ends of its seam, and its area is left out") {
  const Loop outline = square(0.0, 0.0, 4.0, false);
  const std::vector<Loop> holes{square(0.5, 0.5, 1.0, true), square(2.0, 0.5, 0.5, true), square(1.0, 2.5, 1.0, true)};
  const Loop joined = brep::join_holes(outline, holes);
  CHECK(joined.size() == 4 + 3 * (4 + 2));
  double left = area(outline);
  for (const Loop& hole : holes) { left -= area(hole); }
  CHECK(area(joined) == Approx(left).epsilon(1e-12));
  CHECK(area_of_triangles(joined) == Approx(left).epsilon(1e-12));  // more if any two overlapped
}

TEST_CASE("join_holes: a small hole in the corner beside a large one") {
  const Loop outline = square(0.0, 0.0, 10.0, false);
  const std::vector<Loop> holes{square(0.5, 0.5, 8.0, true), square(8.7, 8.7, 0.5, true)};
  const Loop joined = brep::join_holes(outline, holes);
  CHECK(area_of_triangles(joined) == Approx(area(outline) - area(holes[0]) - area(holes[1])).epsilon(1e-12));
}
