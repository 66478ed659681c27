// SPDX-License-Identifier: MIT
// Shortcuts (plan.hpp) change no bit, on random scenes in which their proofs hold for some pairs and not for others.
#include "catch.hpp"

#include <cmath>
#include <random>
#include <utility>

#include <raycast/objects/cone.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/exchange/exchange.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "scenes.hpp"
#include "seed.hpp"

TEST_CASE("shortcuts: no bit changes where curved solids stick out through the walls of a room, nor whether the scene is closed") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  const auto point = [&] { return glm::dvec3{uniform(0, 2), uniform(0, 2), uniform(0, 2)}; };
  for (int i = 0; i < 16; ++i) {
    INFO("scene " << i);
    std::vector<radiosity::SceneObject> objects{scenes::object("room", scenes::box({0, 0, 0}, {2, 2, 2}), 0, true)};
    const glm::dvec3 at = point();
    const double radius = uniform(0.3, 1.2);
    switch (i % 3) {
      case 0:
        objects.push_back(scenes::object("solid", raycast::Sphere::make(at, radius).object, 1));
        break;
      case 1:
        objects.push_back(scenes::object("solid", raycast::Cone::make(at, point(), radius, 0.0).object, 1));
        break;
      default:
        objects.push_back(scenes::object("solid", raycast::Cylinder::make(at, point(), radius).object, 1));
    }
    radiosity::Scene scene;
    scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{1.0}}, {"grey", radiosity::Color{0.3}, radiosity::Color{0.0}}};
    scene.objects = std::move(objects);
    radiosity::Options options{.epsilon = 0.3, .min_area = 0.02, .audit_points = 0, .threads = 1};
    if (i % 2 == 0) {
      options.refinement = radiosity::Refinement::a_posteriori;
      options.target = 0.1;
    }
    const radiosity::Outcome with = radiosity::solve(scene, options);
    options.shortcuts = false;
    const radiosity::Outcome without = radiosity::solve(scene, options);
    REQUIRE(with.solution.has_value() == without.solution.has_value());  // the solid may bury all of the room
    if (!with.solution) { continue; }
    CHECK((with.solution->radiosity == without.solution->radiosity));
    CHECK(with.solution->audit.closure == without.solution->audit.closure);
    CHECK(with.solution->audit.closure_limit == without.solution->audit.closure_limit);
  }
}

TEST_CASE("patches of one plane exchange nothing, however small they are beside their coordinates") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  for (int i = 0; i < 4000; ++i) {
    const double size = std::pow(10.0, uniform(-7.0, -1.0));
    const int axis = i % 3;  // faces of boxes: heights are what rounding of one coordinate leaves
    const glm::dvec3 origin{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    const auto square = [&](double x, double y, double side) {
      radiosity::Polygon corners;
      for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
        glm::dvec3 p = origin;
        p[(axis + 1) % 3] += size * (x + side * u);
        p[(axis + 2) % 3] += size * (y + side * v);
        p[axis] = std::nextafter(p[axis], uniform(-1, 1) > 0.0 ? 2.0 : -2.0);
        corners.push_back(p);
      }
      return radiosity::make_patch(std::move(corners));
    };
    CHECK(radiosity::exchange(square(0.0, 0.0, 1.0), square(1.0, uniform(-1, 1), uniform(0.3, 1.0))) == 0.0);
  }
}
