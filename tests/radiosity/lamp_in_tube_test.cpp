// SPDX-License-Identifier: MIT
// A lamp of many faces in an open tube: what it sends through the ends of the tube is not lost.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <glm/vec3.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/scene/options.hpp>

#include "catch.hpp"
#include "many_scene.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

TEST_CASE("a lamp of many faces within a tube sends through its ends what the tube does not get, also into a room that is not closed",
          "[lamps][accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random{seed};
  std::uniform_real_distribution<> uniform;
  for (int k = 0; k < 3; ++k) {
    constexpr double wide = 3.0, high = 2.5, slot = 0.005;
    const double lamp = 0.05 + 0.02 * uniform(random), tube = lamp * (1.5 + uniform(random)), below = 1.8 - lamp * (1.0 + uniform(random)),
                 above = 1.8 + lamp * (1.0 + uniform(random));
    radiosity::Scene scene;
    scene.materials = {{"wall", radiosity::Color{0.1}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{100.0}}};
    const auto plate = [&](const radiosity::Polygon& corners) { scene.objects.push_back(scenes::plate("wall", corners)); };
    plate({{0, 0, 0}, {wide, 0, 0}, {wide, wide, 0}, {0, wide, 0}});
    plate({{0, 0, high}, {0, wide - slot, high}, {wide, wide - slot, high}, {wide, 0, high}});  // light may leave through the slot
    plate({{0, 0, 0}, {0, wide, 0}, {0, wide, high}, {0, 0, high}});
    plate({{wide, 0, 0}, {wide, 0, high}, {wide, wide, high}, {wide, wide, 0}});
    plate({{0, 0, 0}, {0, 0, high}, {wide, 0, high}, {wide, 0, 0}});
    plate({{0, wide, 0}, {wide, wide, 0}, {wide, wide, high}, {0, wide, high}});
    const glm::dvec3 middle{0.5 * wide, 0.5 * wide, 1.8};
    scene.objects.push_back(scenes::object("lamp", scenes::ball(middle, lamp, 9), 1));
    constexpr int sides = 24;
    for (int i = 0; i < sides; ++i) {
      const auto at = [&](int j, double z) {
        const double angle = 2.0 * std::numbers::pi * j / sides;
        return glm::dvec3{middle.x + tube * std::cos(angle), middle.y + tube * std::sin(angle), z};
      };
      plate({at(i, below), at(i, above), at(i + 1, above), at(i + 1, below)});  // seen from within
    }
    const radiosity::Solution solution = scenes::solved(scene, {.epsilon = 0.01, .min_area = 2e-4, .audit_points = 0, .threads = 1});
    CAPTURE(k, lamp, tube, below, above, solution.audit.clusters);
    CHECK(solution.audit.escaped < 0.02);
  }
}
