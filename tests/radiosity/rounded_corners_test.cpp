// SPDX-License-Identifier: MIT

// Bodies whose corners are rounded, as files have them.

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/mesh.hpp>

#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "lit_world.hpp"
#include "scenes.hpp"
#include "seed.hpp"

// Corners are rounded as files have them, so that the mesh is not quite convex: its shadow is that of the exact one all the same, within
// twice a strip around the outline as wide as the corners are off.
TEST_CASE("direct light: a ball of rounded corners is cut out of the lamp by its outline", "[direct]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 6; ++k) {
    const int around = 20 + static_cast<int>(12 * random.uniform()), rings = around / 2;
    const double radius = 0.1 + 0.2 * random.uniform(), unit = radius * std::pow(10.0, -4.5 + random.uniform());
    const glm::dvec3 middle{0.6 * random.uniform() - 0.3, 0.6 * random.uniform() - 0.3, 0.5 + 0.4 * random.uniform()};
    const auto ball = [&](double rounded_to) {
      std::vector<glm::dvec3> positions;
      std::vector<std::vector<std::uint32_t>> faces;
      for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j < (i % rings == 0 ? 1 : around); ++j) {
          const double t = M_PI * i / rings, p = 2.0 * M_PI * j / around;
          const glm::dvec3 x = middle + radius * glm::dvec3{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
          positions.push_back(rounded_to > 0.0 ? rounded_to * glm::round(x / rounded_to) : x);
        }
      }
      const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(i == 0 ? 0 : i == rings ? 1 + (rings - 1) * around : 1 + (i - 1) * around + j % around);
      };
      for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < around; ++j) {
          if (i > 0) { faces.push_back({at(i, j), at(i + 1, j), at(i, j + 1)}); }
          if (i + 1 < rings) { faces.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)}); }
        }
      }
      radiosity::Scene scene = scenes::floor_under_lamp(0.4);
      const auto mesh = raycast::Mesh::make(positions, faces);
      REQUIRE(mesh);
      scene.objects.push_back(scenes::object("ball", mesh.object, 0));
      return scenes::World{scene};
    };
    const scenes::World exact = ball(0.0), rounded = ball(unit);
    for (int point = 0; point < 5; ++point) {
      const glm::dvec3 x{random.uniform() - 0.5, random.uniform() - 0.5, 0.0};
      auto one = exact.region(x, 0.01), other = rounded.region(x, 0.01);
      REQUIRE(one.size() == 1);
      REQUIRE(other.size() == 1);
      const double found = other.form_factor(0, rounded.in_frame(x), {0, 0, 1}), wanted = one.form_factor(0, exact.in_frame(x), {0, 0, 1});
      CAPTURE(k, around, radius, unit, x.x, x.y, found, wanted);
      CHECK(other.rays() == 0);
      // A strip around the ball, as wide as the diagonal of the rounding and as long as the ball's circumference, at its distance.
      const double distance = middle.z - radius;
      CHECK(std::abs(found - wanted) <= 2.0 * std::sqrt(3.0) * 0.5 * unit * 2.0 * M_PI * radius / (M_PI * distance * distance) + 1e-9);
    }
  }
}
