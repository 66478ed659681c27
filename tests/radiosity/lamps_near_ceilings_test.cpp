// SPDX-License-Identifier: MIT
// Lamps that hang close under a ceiling: as much light comes from them as they send.

#include <cmath>
#include <random>

#include <glm/vec3.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

// What shines brightest is a ceiling that lamps hide from most of the room.
TEST_CASE("a lamp close under a ceiling, hung or touching it, gives a closed room no more light than it sends", "[accuracy]") {
  const auto seed = std::random_device{}();
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
    radiosity::Options options;
    options.epsilon = 0.02;
    options.min_area = 2e-4;
    options.audit_points = 0;
    const radiosity::Audit audit = scenes::solved(scene, options).audit;
    CAPTURE(round, side, gap, *audit.reflected_share, audit.row_sum.min, audit.row_sum.max);
    CHECK(audit.stored_rays > 0);
    CHECK(std::abs(audit.escaped) < 0.005);
  }
}
