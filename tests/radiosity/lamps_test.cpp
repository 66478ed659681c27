// SPDX-License-Identifier: MIT

// Lamps of many faces: as one sender they light a scene as their faces do one by one, for what a few faces cost; what shines everywhere is
// no lamp and is as exact as ever.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/sphere.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/rays/ray_choice.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "many_scene.hpp"
#include "random_points.hpp"
#include "scenes.hpp"
#include "solved.hpp"

using radiosity::Color;
using radiosity::Scene;
using scenes::point;
using scenes::uniform;

namespace {

// A closed room of random proportions with blocks on its floor, and a lamp of radius 0.08 of one W at a random place above them.
Scene room_around(std::uint64_t seed, std::uint32_t n) {
  std::mt19937_64 random{seed};
  Scene scene;
  const glm::dvec3 size{uniform(random, 1.0, 1.6), uniform(random, 1.0, 1.6), uniform(random, 0.9, 1.3)};
  const double r = 0.08;
  scene.materials = {{"wall", Color{uniform(random, 0.3, 0.7)}, Color{0.0}},
                     {"block", Color{uniform(random, 0.3, 0.7)}, Color{0.0}},
                     {"lamp", Color{0.1}, Color{1.0 / (4.0 * std::numbers::pi * r * r)}}};
  scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, size), 0, true)};
  for (int k = 0; k < 2; ++k) {
    const glm::dvec3 lo{uniform(random, 0.1, 0.3) + 0.5 * k, uniform(random, 0.1, 0.5), 0.0};
    scene.objects.push_back(scenes::object("block", scenes::box(lo, lo + glm::dvec3{0.25, 0.3, uniform(random, 0.1, 0.3)}), 1));
  }
  const glm::dvec3 centre{uniform(random, 0.3, size.x - 0.3), uniform(random, 0.3, size.y - 0.3), size.z - 0.35};
  scene.objects.push_back(scenes::object("lamp", n > 0 ? scenes::ball(centre, r, n) : raycast::Sphere::make(centre, r).object, 2));
  return scene;
}

radiosity::Options by_rays(double epsilon = 0.02) {
  return {.epsilon = epsilon, .indirect = radiosity::Indirect::rays, .audit_points = 0, .threads = 1};
}

// Mean irradiance, weighted by area, of what does not shine: by surface.
std::vector<Color> reflecting(const Scene& scene, const radiosity::Solution& solution) {
  std::vector<Color> result;
  const auto inputs = radiosity::surfaces(scene);
  for (std::size_t s = 0; s < inputs.size(); ++s) {
    if (radiosity::is_black(scene.materials[inputs[s].material].emission)) { result.push_back(solution.audit.surfaces[s].radiosity); }
  }
  return result;
}

}  // namespace

TEST_CASE("a lamp of many faces lights a random room as the sphere does, for what a lamp of few costs", "[lamps][accuracy]") {
  for (const std::uint64_t seed : {5u, 6u, 7u}) {
    CAPTURE(seed);
    radiosity::Options by_links = by_rays(0.01);
    by_links.indirect = radiosity::Indirect::links;
    const Scene sphere = room_around(seed, 0);
    const std::vector<Color> expected = reflecting(sphere, scenes::solved(sphere, by_links));
    std::uint64_t first_links = 0;
    for (const std::uint32_t n : {6u, 12u, 24u}) {  // 120 to 2208 faces
      const Scene scene = room_around(seed, n);
      const radiosity::Solution solution = scenes::solved(scene, by_rays());
      REQUIRE(solution.audit.stored_rays > 0);
      REQUIRE(solution.audit.clusters > 0);
      const std::vector<Color> found = reflecting(scene, solution);
      REQUIRE(found.size() == expected.size());
      double square = 0.0, norm = 0.0, worst = 0.0, brightest = 0.0;
      for (std::size_t s = 0; s < found.size(); ++s) {
        square += std::pow(found[s].x - expected[s].x, 2);
        norm += expected[s].x * expected[s].x;
        worst = std::max(worst, std::abs(found[s].x - expected[s].x));
        brightest = std::max(brightest, expected[s].x);
      }
      CAPTURE(n, std::sqrt(square / norm), worst / brightest);
      // Means over whole surfaces: of the lamp 1 % by its points, of the rays the noise of a caster over the root of their number, and what
      // both runs miss at their thresholds.
      CHECK(std::sqrt(square / norm) < 0.02);
      CHECK(worst < 0.04 * brightest);
      CHECK(solution.audit.energy_balance < 1e-5);
      if (first_links == 0) { first_links = solution.audit.links; }
      CHECK(solution.audit.links < 3 * first_links / 2);
    }
  }
}

TEST_CASE("where most faces shine, rays carry their light: a furnace stays exact, and a bulb in a glowing room is lit as by links",
          "[lamps]") {
  const std::uint64_t seed = 9;
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  for (int k = 0; k < 3; ++k) {
    const double rho = uniform(random, 0.1, 0.95);
    CAPTURE(rho);
    const Scene furnace = scenes::many(150, scenes::Things::boxes, rho);
    const radiosity::Solution solution = scenes::solved(furnace, by_rays(0.05));
    CHECK(solution.audit.stored_rays > 0);
    CHECK(solution.audit.links == solution.audit.ray_links);
    for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
      if (solution.hierarchy[i].leaf() && solution.area[i] > 0.0) { CHECK(std::abs(solution.radiosity[i].x - 1.0) < 1e-3); }
    }
  }
  Scene glowing = room_around(4, 8);
  glowing.materials[0].emission = Color{0.1};
  glowing.materials[1].emission = Color{0.05};
  radiosity::Options links = by_rays(0.02);
  links.indirect = radiosity::Indirect::links;
  const radiosity::Solution expected = scenes::solved(glowing, links);
  const radiosity::Solution found = scenes::solved(glowing, by_rays());
  CHECK(found.audit.clusters > 0);
  CHECK(found.audit.stored_rays > 0);
  double square = 0.0, norm = 0.0;
  for (std::size_t s = 0; s < 18; ++s) {  // of room and blocks
    const double emission = s < 6 ? 0.1 : 0.05;
    square += std::pow(found.audit.surfaces[s].radiosity.x - expected.audit.surfaces[s].radiosity.x, 2);
    norm += std::pow(expected.audit.surfaces[s].radiosity.x - emission, 2);
  }
  CHECK(std::sqrt(square / norm) < 0.02);
}

TEST_CASE("lamps of many faces do not depend on the number of threads", "[lamps]") {
  const Scene scene = room_around(8, 8);
  radiosity::Options options = by_rays(0.05);
  const radiosity::Solution one = scenes::solved(scene, options);
  options.threads = 3;
  const radiosity::Solution three = scenes::solved(scene, options);
  CHECK(one.radiosity == three.radiosity);
}

TEST_CASE("direct light: many sheets that shine alike are few lamps, and light as their faces do", "[lamps][direct]") {
  const std::uint64_t seed = 12;
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  for (const bool apart : {false, true}) {  // one ball of 480 triangles; 100 plates
    Scene scene;
    scene.materials = {{"white", Color{0.5}, Color{0.0}}, {"lamp", Color{0.1}, Color{1.0}}};
    scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true)};
    for (int k = 0; k < 100 && apart; ++k) {
      scene.objects.push_back(scenes::square("lamp", point(random, -0.8, 0.8) + glm::dvec3{0, 0, 2}, 0.03, false, 1));
    }
    if (!apart) { scene.objects.push_back(scenes::object("lamp", scenes::ball({0.2, 0.1, 0.8}, 0.1, 11), 1)); }
    const radiosity::PrepareResult made = radiosity::prepare(scene);
    REQUIRE(made.prepared);
    const radiosity::Prepared& p = *made.prepared;
    std::vector<Color> emission;
    for (const auto& s : radiosity::surfaces(scene)) { emission.push_back(scene.materials[s.material].emission); }
    const radiosity::DirectLight light{p.objects, p.surfaces, emission, {64, 1.0, true}};
    CHECK(light.lamps().size() <= (apart ? 64 : 1));
    for (std::uint32_t s = 1; s < emission.size(); ++s) { CHECK(light.is_lamp(s)); }
    for (int k = 0; k < 20; ++k) {
      const glm::dvec3 x = (glm::dvec3{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), 0} - p.frame.centre) * p.frame.scale;
      const double r = 0.05 * p.frame.scale;
      const std::array<glm::dvec3, 4> contour{x + glm::dvec3{-r, -r, 0}, x + glm::dvec3{r, -r, 0}, x + glm::dvec3{r, r, 0},
                                              x + glm::dvec3{-r, r, 0}};
      radiosity::LitRegion region{light, {contour, 0, 0.0}, {0, 0, 1}};
      double unhidden = 0.0;
      for (std::size_t l = 0; l < region.size(); ++l) { unhidden += region.unhidden(l, x, {0, 0, 1}); }
      double expected = 0.0;
      std::vector<char> facing;
      for (std::size_t o = 1; o < p.surfaces.size(); ++o) {
        expected += radiosity::form_factor(radiosity::facets_of(p.surfaces[o]), x, {0, 0, 1}, 0.0, facing);
      }
      CHECK(unhidden == test::Approx(expected).epsilon(1e-9));  // sums of some hundred terms in another order
    }
  }
}
