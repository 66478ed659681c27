// SPDX-License-Identifier: MIT

// Light of near places, as paths find it, against form factors.

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/near_light.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

// A floor under a black lamp, from a spot to a sky: what the floor sends back is half of what comes to it, within five standard errors, and
// 1 % for the 256 points that stand for the lamp.
TEST_CASE("near places are lit by a lamp of any size at any distance as its form factor says", "[picture][accuracy]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(12, random(1, 1'000'000))));
  radiosity::Random random{seed, 0};
  const double half = 0.03 * std::pow(300.0, random.uniform()), height = 0.05 * std::pow(40.0, random.uniform());
  const glm::dvec3 middle{random.uniform() - 0.5, random.uniform() - 0.5, height}, x{random.uniform() - 0.5, random.uniform() - 0.5, 0.0};
  CAPTURE(seed, half, height);
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true), scenes::square("lamp", middle, half, false, 1)};
  const radiosity::Options options{.epsilon = 0.1, .audit_points = 0};
  const radiosity::Solution solution = scenes::solved(scene, options);
  const radiosity::Lookup lookup{scene, solution.mesh, solution.frame};
  const radiosity::DirectLight direct{
      lookup.objects(), scenes::boundaries(lookup.objects()), {radiosity::Color{0.0}, radiosity::Color{1.0}}};
  REQUIRE(direct.is_lamp(1));
  const radiosity::PhotonGrid no_photons;
  const radiosity::NearLight near{lookup, direct, scene.materials, no_photons};
  const radiosity::NearLight::Seen seen{{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, 0}, radiosity::Color{1.0}};
  constexpr int families = 256;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t key = 0; key < families; ++key) {
    const double value = near.light({&seen, 1}, 64, radiosity::scramble(seed) + key, nullptr).light.x;
    sum += value / families;
    squares += value * value / families;
  }
  const std::vector<glm::dvec3> corners{middle + glm::dvec3{-half, half, 0}, middle + glm::dvec3{half, half, 0},
                                        middle + glm::dvec3{half, -half, 0}, middle + glm::dvec3{-half, -half, 0}};
  const double truth = 0.5 * radiosity::point_to_polygon(x, {0, 0, 1}, corners);
  const double error = std::sqrt((squares - sum * sum) / (families - 1));
  CHECK(std::abs(sum - truth) < 5.0 * error + 0.01 * truth);
}
