// SPDX-License-Identifier: MIT
// Outlines that come within rounding of themselves: their parts cover each point once, within rounding.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/ears.hpp>
#include <brep/geometry.hpp>
#include <brep/polygon.hpp>
#include <brep/split.hpp>

#include "near_contacts.hpp"
#include "seed.hpp"
#include "shapes.hpp"

using namespace brep;
using shapes::Mesh;

namespace {

// A gap of up to 1e-9 may lie beyond the contact, along an edge or at a corner; the parts of up to 200 corners overlap by no more. What is
// cut off from an outline without such a shift is off by rounding alone.
constexpr double tolerance = 1e-8;

// Collects the areas of parts of an outline, along its normal.
struct Cover {
  explicit Cover(Polygon whole) : outline(whole), n(normal(whole)) {}
  void add(Polygon part) {
    const double a = glm::dot(vector_area(part), n);
    sum += a;
    turned_over -= std::min(a, 0.0);
  }
  void check() const {
    const double square = extent(outline) * extent(outline);
    CHECK(std::abs(sum - area(outline)) <= 1e-13 * square);
    CHECK(turned_over <= tolerance * square);
  }
  Polygon outline;
  glm::dvec3 n;
  double sum = 0.0, turned_over = 0.0;
};

Mesh pillow(Polygon points) {
  Builder b;
  std::vector<std::uint32_t> front, back;
  for (const glm::dvec3& p : points) {
    front.push_back(b.vertex(p));
    back.insert(back.begin(), front.back());
  }
  b.face(front, 0);
  b.face(back, 0);
  return shapes::build(b);
}

}  // namespace

TEST_CASE("an outline within rounding of itself: its ears and its nearly convex parts cover each of its points once") {
  const std::uint32_t start = test::seed();
  for (std::uint32_t seed = start; seed < start + 3000; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    const std::vector<glm::dvec3> points = near_contacts::outline(random);
    Cover by_ears(points), by_parts(points);
    for (const auto& [a, b, c] : ears(points)) { by_ears.add(std::vector{points[a], points[b], points[c]}); }
    by_ears.check();
    if (points.size() < 4) { continue; }
    Mesh m = pillow(points);
    const auto parts = split_nearly_simple(m, FaceId{0});
    REQUIRE(parts);
    for (const FaceId f : *parts) {
      CHECK((triangles(m, f) || is_convex(m, f)));
      by_parts.add(positions(m, f));
    }
    by_parts.check();
  }
}

TEST_CASE("an outline of many corners that crosses itself everywhere is refused, and nothing changes") {
  const std::uint32_t seed = test::seed();
  INFO("seed " << seed);
  shapes::Random random(seed);
  std::vector<glm::dvec3> points(most_corners_of_least_overlap + 500);
  for (glm::dvec3& p : points) { p = {random.unit(), random.unit(), 0.0}; }
  Mesh m = pillow(points);
  const auto parts = split_nearly_simple(m, FaceId{0});
  REQUIRE_FALSE(parts);
  CHECK(parts.refusal().code == Code::not_simple);
  CHECK(m.face_count() == 2);
  CHECK(degree(m, FaceId{0}) == points.size());
}
