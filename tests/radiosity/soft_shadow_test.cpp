// SPDX-License-Identifier: MIT
// Soft shadows of curved lamps: a straight edge before a ball or a tube, of which a point sees the share that simple geometry gives.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/options.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

constexpr double radius = 0.01, height = 2.0, gap = 0.04;  // of the lamp, above a floor; of the edge, below the lamp

// A lamp above the origin; a black plate just beneath it is cut off at a distance `edge` from the axis in direction `turn`. Many plates
// beside each other, so that their shadows are found by segments.
radiosity::Scene before_edge(std::shared_ptr<const raycast::Object> lamp, double edge, double turn) {
  const auto at = [&](double x, double y) {
    return glm::dvec3{std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y, height - gap};
  };
  radiosity::Scene scene;
  scene.materials = {{"floor", radiosity::Color{0.5}, radiosity::Color{0.0}},
                     {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0 / (radius * radius)}},
                     {"black", radiosity::Color{0.0}, radiosity::Color{0.0}}};
  scene.objects = {scenes::plate("floor", {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}, 0),
                   scenes::object("lamp", std::move(lamp), 1)};
  constexpr int plates = 20;
  for (int k = 0; k < plates; ++k) {
    const double y0 = -0.4 + 0.8 * k / plates, y1 = -0.4 + 0.8 * (k + 1) / plates;
    scene.objects.push_back(scenes::plate("plate", {at(edge, y0), at(edge, y1), at(0.5, y1), at(0.5, y0)}, 2));
  }
  return scene;
}

// The irradiance below the lamp.
double below(const radiosity::Scene& scene) {
  const radiosity::Solution solution = scenes::solved(scene, {.epsilon = 0.5, .min_area = 0.01, .audit_points = 0, .threads = 1});
  const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
  const glm::dvec3 p = -solution.frame.centre * solution.frame.scale, up{0, 0, 1};
  const std::array<glm::dvec3, 4> contour{p, p, p, p};
  radiosity::LitRegion region{light.direct(), {contour, 0, 0.0}, up};
  return region.irradiance(p, up).x;
}

}  // namespace

TEST_CASE("soft shadows: of a ball or a tube behind a straight edge a point sees what geometry says, without bias", "[lamps][accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random{seed};
  std::uniform_real_distribution<> uniform;
  const glm::dvec3 middle{0, 0, height};
  for (const bool tube : {false, true}) {
    const int edges = tube ? 100 : 40;  // single shares are .026 off for a tube (RMS), .009 for a ball
    double all = 0.0, squares = 0.0, sum = 0.0;
    for (int k = 0; k < edges; ++k) {
      const double turn = 2.0 * std::numbers::pi * uniform(random), at = 1.8 * uniform(random) - 0.9;  // seen, in radii
      const glm::dvec3 along{-std::sin(turn), std::cos(turn), 0.0};                                    // a tube lies along the edge
      std::shared_ptr<const raycast::Object> lamp = raycast::Sphere::make(middle, radius).object;
      if (tube) { lamp = raycast::Cylinder::make(middle - 0.1 * along, 0.2 * along, radius).object; }
      const double edge = at * radius * (height - gap) / height;
      if (k == 0) { all = below(before_edge(lamp, 0.3, turn)); }
      const double found = below(before_edge(lamp, edge, turn)) / all;
      const double expected = tube ? 0.5 + 0.5 * at : 1.0 - (std::acos(at) - at * std::sqrt(1.0 - at * at)) / std::numbers::pi;
      squares += (found - expected) * (found - expected) / edges;
      sum += (found - expected) / edges;
    }
    CAPTURE(tube, sum);
    CHECK(std::sqrt(squares) < (tube ? 0.035 : 0.014));
    CHECK(std::abs(sum) < (tube ? 0.012 : 0.006));  // some four standard errors
  }
}
