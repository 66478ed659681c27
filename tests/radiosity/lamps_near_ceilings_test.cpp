// SPDX-License-Identifier: MIT
// Lamps that hang close under a ceiling: as much light comes from them as they send.

#include <cmath>
#include <random>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/rays/ray_choice.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

// What shines brightest is a ceiling that lamps hide from most of the room.
TEST_CASE("a lamp close under a ceiling, hung or touching it, gives a closed room no more light than it sends", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>{lo, hi}(random); };
  for (int round = 0; round < 4; ++round) {
    const glm::dvec3 size{between(3.0, 5.0), between(3.0, 5.0), between(2.3, 3.0)};
    const double side = between(0.2, 0.5), gap = between(0.005, 0.1), thick = between(0.01, 0.05);
    const glm::dvec3 lo{between(0.5, 2.0), between(0.5, 2.0), size.z - gap - thick};
    radiosity::Scene scene;
    scene.materials = {{"wall", radiosity::Color{0.7}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.1}, radiosity::Color{40.0}}};
    scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, size), 0, true),
                     scenes::object("lamp", scenes::box(lo, lo + glm::dvec3{side, side, thick}), 1)};
    const radiosity::Options options{.epsilon = 0.02, .min_area = 2e-4, .audit_points = 0};
    const radiosity::Audit audit = scenes::solved(scene, options).audit;
    CAPTURE(round, side, gap, *audit.reflected_share, audit.row_sum.min, audit.row_sum.max);
    CHECK((audit.stored_rays > 0) == (*audit.reflected_share > radiosity::least_share_beside_lamps));
    CHECK(std::abs(audit.escaped) < 0.005);
  }
}

// A patch of the ceiling that reaches out from behind the lamp would take light beside it and give a part of that to the lamp's back.
TEST_CASE("a wide lamp close under a ceiling lights a floor as one that lies on the ceiling", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>{lo, hi}(random); };
  for (int round = 0; round < 4; ++round) {
    const glm::dvec3 size{between(3.0, 5.0), between(3.0, 5.0), between(2.3, 3.0)};
    const glm::dvec2 extent{between(0.5, 0.7) * size.x, between(0.5, 0.7) * size.y};
    const glm::dvec2 corner{between(0.1, 0.9) * (size.x - extent.x), between(0.1, 0.9) * (size.y - extent.y)};
    const double gap = between(0.001, 0.01);
    const auto floor_light = [&](double below) {
      const double z = size.z - below;
      radiosity::Scene scene;
      scene.materials = {{"wall", radiosity::Color{0.8}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{10.0}}};
      scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, size), 0, true),
                       scenes::object("lamp",
                                      scenes::polygon({{corner.x, corner.y, z},
                                                       {corner.x, corner.y + extent.y, z},
                                                       {corner.x + extent.x, corner.y + extent.y, z},
                                                       {corner.x + extent.x, corner.y, z}}),
                                      1)};
      const radiosity::Options options{.audit_points = 0};
      double light = 0.0;
      for (const radiosity::SurfaceMean& surface : scenes::solved(scene, options).audit.surfaces) {
        if (surface.name == "room.z0") { light = surface.radiosity.x; }
      }
      return light;
    };
    const double lying = floor_light(0.0), hung = floor_light(gap);
    CAPTURE(round, size.x, size.y, size.z, extent.x, extent.y, corner.x, corner.y, gap, lying, hung);
    // What falls into the gap between ceiling and lamp meets the black back of the lamp and is lost. The opening of the gap gets about half
    // of the mean irradiance of what absorbs (.35 to .76 was found).
    const double lamp_area = extent.x * extent.y, walls = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x) - lamp_area;
    const double lost = 0.5 * 2.0 * (extent.x + extent.y) * gap / ((1.0 - 0.8) * walls + lamp_area);
    CHECK(hung == Approx(lying * (1.0 - lost)).epsilon(0.002));
  }
}
