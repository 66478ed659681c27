// SPDX-License-Identifier: MIT

// Paths that are aimed at bright places: they find the same light as others, with less noise.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/box.hpp>

#include <radiosity/audit/bright_places.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/direct/lamp_photons.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "shaded_lamp.hpp"

namespace {

using radiosity::BrightPlaces;

glm::dvec3 in_cube(radiosity::Random& random) { return {random.uniform(), random.uniform(), random.uniform()}; }

glm::dvec3 any_direction(radiosity::Random& random) {
  const glm::dvec3 up{0, 0, random.uniform() < 0.5 ? 1 : -1};
  const double u = random.uniform();
  return radiosity::cosine_direction(up, u, random.uniform());
}

}  // namespace

// Of light on random small disks in a cube, whose photons land anywhere: cosine / pi over the density of a direction has the mean 1, the
// integral of cosine / pi over the hemisphere, from any point and whichever way it faces, within five standard errors.
TEST_CASE("directions to bright places have the density that they say", "[audit]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(4, random(1, 1'000'000))));
  CAPTURE(seed);
  radiosity::Random random{seed, 0};
  std::vector<BrightPlaces::Reflected> light;
  for (int disk = 0; disk < 5; ++disk) {
    const glm::dvec3 middle = in_cube(random), normal = any_direction(random);
    const double radius = 0.04 * std::pow(1e-5, random.uniform());
    for (int k = 0; k < 200; ++k) {
      glm::dvec3 d = any_direction(random);
      d -= glm::dot(d, normal) * normal;
      light.push_back({{{middle + radius * d, normal}, 0, 0}, 0.1 + random.uniform()});
    }
  }
  const auto meet = [&](const raycast::ScenePoint& from, const glm::dvec3& direction) -> std::optional<raycast::ScenePoint> {
    return raycast::ScenePoint{{from.position + random.uniform() * direction, -direction}, 0, 0};
  };
  const BrightPlaces places{light, {6.0, std::numbers::sqrt3, 0.05 + 0.9 * random.uniform(), 4096}, meet};
  REQUIRE_FALSE(places.empty());
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 x = i % 4 == 0 ? light[static_cast<std::size_t>(25 * i)].from.position : in_cube(random);
    const glm::dvec3 normal = any_direction(random);
    const BrightPlaces::From from{places, x, normal};
    constexpr int directions = 4000;
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < directions; ++k) {
      const std::optional<glm::dvec3> w = from.direction(random);
      const double weight = w ? glm::dot(*w, normal) * std::numbers::inv_pi / from.density(*w) : 0.0;
      sum += weight / directions;
      squares += weight * weight / directions;
    }
    CHECK(std::abs(sum - 1.0) < 5.0 * std::sqrt((squares - sum * sum) / directions));
  }
}

// On the walls of a room with a lamp in a shade. The means agree within five standard errors; the variance of a path falls at least to a
// quarter (found: to a tenth or less).
TEST_CASE("paths aimed at the inside of a shade find the light of a room, with less noise", "[audit][accuracy]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(2, random(1, 1'000'000))));
  CAPTURE(seed);
  const radiosity::Scene scene = scenes::shaded_lamp(seed);
  const auto prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  const radiosity::Prepared& p = *prepared.prepared;
  const radiosity::PathTracer plain{scene, p.objects, p.surfaces};
  const std::optional<radiosity::PathTracer> aimed = plain.aimed(p.surfaces);
  REQUIRE(aimed);
  constexpr int points = 4000, paths = 16;
  struct Found {
    double sum = 0.0, squares = 0.0, variance = 0.0;
  };
  const auto traced = [&](const radiosity::PathTracer& tracer) {
    Found found;
    for (std::uint64_t i = 0; i < points; ++i) {
      radiosity::Random random{seed, i, 1};
      const glm::dvec3 x{4.0, 4.0 * random.uniform(), 2.8 * random.uniform()};
      double mean = 0.0, squares = 0.0;
      for (int k = 0; k < paths; ++k) {
        std::uint64_t rays = 0;
        const double b = tracer.radiosity({{(x - p.frame.centre) * p.frame.scale, {-1, 0, 0}}, 0, 1}, random, rays).all.x;
        mean += b / paths;
        squares += b * b / paths;
      }
      found.sum += mean / points;
      found.squares += mean * mean / points;
      found.variance += (squares - mean * mean) / points;
    }
    return found;
  };
  const Found by_chance = traced(plain), by_aim = traced(*aimed);
  const auto error = [&](const Found& found) { return (found.squares - found.sum * found.sum) / points; };
  CAPTURE(by_chance.sum, by_aim.sum, by_chance.variance, by_aim.variance);
  CHECK(std::abs(by_chance.sum - by_aim.sum) < 5.0 * std::sqrt(error(by_chance) + error(by_aim)));
  CHECK(by_aim.variance < 0.25 * by_chance.variance);
}

// A lamp that lights all walls alike makes no place bright.
TEST_CASE("an evenly lit room has no bright places", "[audit]") {
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  scene.objects = {scenes::object("room", raycast::BoxObject::make({0, 0, 0}, {1, 1, 1}).object, 0, true),
                   scenes::object("lamp", raycast::BoxObject::make({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}).object, 1)};
  const auto prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  const radiosity::PathTracer tracer{scene, prepared.prepared->objects, prepared.prepared->surfaces};
  CHECK_FALSE(tracer.aimed(prepared.prepared->surfaces));
}
