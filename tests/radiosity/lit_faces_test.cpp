// SPDX-License-Identifier: MIT
// The area to which thresholds are relative does not jump when lamps change a little.

#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

// Leaves of a room whose walls shine, but for the last of these objects, which has the second material.
std::uint64_t leaves(std::vector<radiosity::SceneObject> objects, double emission) {
  radiosity::Scene scene;
  scene.materials = {{"bright", radiosity::Color{0.5}, radiosity::Color{1.0}},
                     {"other", radiosity::Color{0.5}, radiosity::Color{emission}}};
  scene.objects = std::move(objects);
  const radiosity::Options options{.epsilon = 0.02, .min_area = 1e-3, .audit_points = 0};
  return scenes::solved(scene, options).audit.leaves;
}

}  // namespace

TEST_CASE("in a room that shines a small thing that shines a little less costs no more than one that shines as much") {
  for (const double side : {0.3, 0.1, 0.03}) {
    const auto with = [&](double emission) {
      return leaves({scenes::object("room", scenes::box({0, 0, 0}, {3, 4, 2}), 0, true),
                     scenes::object("thing", scenes::box({1, 1, 1}, glm::dvec3{1.0 + side}), 1)},
                    emission);
    };
    const std::uint64_t alike = with(1.0);
    CAPTURE(side, alike);
    for (const double emission : {1.001, 0.999, 0.99, 0.9}) {
      CHECK(static_cast<double>(with(emission)) < 1.25 * static_cast<double>(alike));
    }
    // All walls count half as much as what is dark, so patches may be half as large.
    CHECK(static_cast<double>(with(0.0)) < 4.0 * static_cast<double>(alike));
  }
}

TEST_CASE("of the walls of a room that shines one may shine a little less") {
  const auto with = [&](double emission) {
    return leaves({scenes::object("ceiling", scenes::polygon({{0, 0, 2}, {0, 4, 2}, {3, 4, 2}, {3, 0, 2}}), 0),
                   scenes::object("floor", scenes::polygon({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}}), 1)},
                  emission);
  };
  const std::uint64_t alike = with(1.0);
  for (const double emission : {1.001, 0.999, 0.9}) {
    CAPTURE(alike, emission);
    CHECK(static_cast<double>(with(emission)) < 1.25 * static_cast<double>(alike));
  }
}
