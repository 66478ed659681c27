// SPDX-License-Identifier: MIT

// What is cut out of the pieces of a lamp, by quick tests and without.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <radiosity/support/random.hpp>
#include <radiosity/visibility/shadow.hpp>

#include "catch.hpp"

// A sphere around a piece tells the side of a plane only where it is sure of it.
TEST_CASE("cones cut the same out of pieces with known spheres as out of others") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(4, random(1, 1'000'000))));
  CAPTURE(seed);
  radiosity::Random random{seed, 0};
  const auto number = [&] { return 2.0 * random.uniform() - 1.0; };
  std::vector<radiosity::Piece> plain;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 a{number(), number(), 1.0};
    const double size = 0.01 * std::pow(100.0, random.uniform());
    radiosity::Piece& piece = plain.emplace_back();
    for (const glm::dvec2& p : {glm::dvec2{1, 0}, glm::dvec2{0, 1}, glm::dvec2{-1, -1}}) { piece.push_back(a + size * glm::dvec3{p, 0.0}); }
  }
  std::vector<radiosity::Piece> bounded = plain;
  for (radiosity::Piece& piece : bounded) { piece.bound(); }
  for (int cone = 0; cone < 20; ++cone) {
    const glm::dvec3 c{number(), number(), 1.0};
    const double size = 0.02 * std::pow(20.0, random.uniform());
    std::vector<radiosity::HalfSpace> planes;
    for (const glm::dvec3& side : {glm::dvec3{1, 0, 0}, glm::dvec3{-1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, -1, 0}}) {
      planes.push_back({c - size * side, (0.1 + random.uniform()) * side});
    }
    radiosity::detail::cut_away(plain, planes);
    radiosity::detail::cut_away(bounded, planes);
    REQUIRE(plain.size() == bounded.size());
  }
  for (std::size_t i = 0; i < plain.size(); ++i) {
    CHECK(std::equal(plain[i].begin(), plain[i].end(), bounded[i].begin(), bounded[i].end()));
  }
}
