// SPDX-License-Identifier: MIT
// Points of indirect light: what lies between them.
#include "catch.hpp"

#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <radiosity/support/random.hpp>

#include "apps/indirect_points.hpp"

namespace {

using radiosity::Color;

// A point of the plane z = 0, of which pixel (x, y) shows the square from (x, y) to (x + 1, y + 1), in hundredths.
apps::IndirectPoint point_at(double x, double y, double radius, const Color& light) {
  apps::IndirectPoint point;
  point.position = {0.01 * x, 0.01 * y, 0.0};
  point.normal = {0.0, 0.0, 1.0};
  point.x = static_cast<std::uint32_t>(x);
  point.y = static_cast<std::uint32_t>(y);
  point.radius = 0.01 * radius;
  point.pixels = radius;
  point.gathered = light;
  return point;
}

}  // namespace

// A least-squares plane through values of a linear field is the field, whatever the weights; so is every blend of such planes. What holds the
// slopes down takes 0.001 / variance of them: 2 % where the points of a ball spread by 0.22 of its radius, which is little for ten of them.
TEST_CASE("between points of indirect light a linear field is exact, wherever the points are") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    radiosity::Random random{seed, 0};
    const auto uniform = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
    const Color middle{uniform(5, 9), uniform(5, 9), uniform(5, 9)}, by_x{uniform(-2, 2), uniform(-2, 2), 0.0},
        by_y{uniform(-2, 2), 0.0, 1.0};
    const auto field = [&](double x, double y) { return middle + 0.01 * x * by_x + 0.01 * y * by_y; };
    apps::IndirectPoints points{100, 80};
    for (int k = 0; k < 150; ++k) {
      const double x = uniform(0, 100), y = uniform(0, 80);
      points.add(point_at(x, y, uniform(15, 30), field(x, y)));
    }
    for (std::size_t i = 0; i < points.size(); ++i) { points.fit(i); }
    for (int k = 0; k < 300; ++k) {
      const double x = uniform(10, 90), y = uniform(10, 70);
      const auto found = points.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {0.01 * x, 0.01 * y, 0.0}, {0, 0, 1}, 0);
      REQUIRE(found);
      CHECK(glm::length(*found - field(x, y)) < 0.02 * 0.3 * glm::length(glm::abs(by_x) + glm::abs(by_y)));
    }
  }
}

TEST_CASE("a point of indirect light says nothing about another object, another side of a crease, or what lies off its plane") {
  apps::IndirectPoints points{100, 80};
  points.add(point_at(50, 40, 20, Color{1.0}));
  points.fit(0);
  const glm::dvec3 place{0.5, 0.4, 0.0}, up{0, 0, 1};
  CHECK(points.covered(50, 40, place, up, 0));
  CHECK(points.at(50, 40, place, up, 0) == Color{1.0});
  CHECK_FALSE(points.at(50, 40, place, up, 1));
  CHECK_FALSE(points.at(50, 40, place, glm::normalize(glm::dvec3{1, 0, 1}), 0));
  CHECK_FALSE(points.at(50, 40, place + glm::dvec3{0, 0, 0.05}, up, 0));
  CHECK_FALSE(points.at(71, 40, place + glm::dvec3{0.201, 0, 0}, up, 0));
}
