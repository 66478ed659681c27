// SPDX-License-Identifier: MIT

// Direct light of many lamps: what each can add to the light of the others decides how many segments tell what is seen of it.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <raycast/objects/box.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/torus.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "lit_world.hpp"
#include "scenes.hpp"

using radiosity::Color;
using radiosity::Random;

namespace {

glm::dvec3 in_cube(Random& random) { return 2.0 * glm::dvec3{random.uniform(), random.uniform(), random.uniform()} - 1.0; }

// A floor, `count` square lamps of different size and colour above it, and rings and boxes in between.
radiosity::Scene many_lamps(Random& random, std::size_t count) {
  radiosity::Scene scene;
  scene.materials = {{"grey", Color{0.5}, Color{0.0}}};
  const auto add = [&](const auto& made, std::uint32_t material) { scene.objects.push_back({"thing", made.object, {}, {material}}); };
  add(raycast::Polygon::make({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}), 0);
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec3 at = glm::dvec3{0, 0, 2} + in_cube(random) * glm::dvec3{2, 2, 0.3};
    const double r = 0.05 + 0.1 * random.uniform();
    scene.materials.push_back({"lamp", Color{0.0}, Color{random.uniform(), random.uniform(), random.uniform()} + 0.1});
    add(raycast::Polygon::make(
            {at + glm::dvec3{-r, -r, 0}, at + glm::dvec3{-r, r, 0}, at + glm::dvec3{r, r, 0}, at + glm::dvec3{r, -r, 0}}),
        static_cast<std::uint32_t>(k + 1));
  }
  for (int k = 0; k < 12; ++k) {
    const glm::dvec3 at = glm::dvec3{0, 0, 0.8} + in_cube(random) * glm::dvec3{1.5, 1.5, 0.4};
    const double r = 0.1 + 0.3 * random.uniform();
    if (k % 2 == 0) {
      add(raycast::Torus::make(at, glm::normalize(in_cube(random)), r, 0.3 * r), 0);
    } else {
      add(raycast::BoxObject::make(at - 0.4 * r, at + 0.4 * r), 0);
    }
  }
  return scene;
}

}  // namespace

TEST_CASE("direct light: of many lamps all light is known as well as that of one, with few segments for each", "[direct]") {
  const auto seed = std::random_device{}();
  INFO("seed " << seed);
  Random random{seed, 0x6c616d7073ull};
  double squares = 0.0, all_squares = 0.0;
  std::uint64_t rays = 0, rays_alone = 0;
  for (int round = 0; round < 12; ++round) {
    const scenes::World world{many_lamps(random, 30)};
    const glm::dvec3 middle = in_cube(random) * glm::dvec3{1, 1, 0};
    auto region = world.region(middle, 0.02), alone = world.region(middle, 0.02);
    for (int k = 0; k < 10; ++k) {
      const glm::dvec3 x = world.in_frame(middle + 0.02 * in_cube(random) * glm::dvec3{1, 1, 0}), n{0, 0, 1};
      Color each{0.0};
      for (std::size_t l = 0; l < alone.size(); ++l) { each += alone.lamp(l).exitance * alone.form_factor(l, x, n); }
      const Color off = region.irradiance(x, n) - each;
      squares += glm::dot(off, off);
      all_squares += glm::dot(each, each);
    }
    rays += region.rays();
    rays_alone += alone.rays();
  }
  CHECK(std::sqrt(squares / all_squares) < 0.005);  // .0013 to .0027 have been seen
  CHECK(2 * rays < rays_alone);                     // .16 to .33
}

// What the points of one lamp miss, those of others of the same shape must not miss, too. Half of each is never seen.
TEST_CASE("direct light: of many lamps alike that are sunk into a ceiling the light is that of their lower halves", "[direct]") {
  radiosity::Scene scene;
  scene.materials = {{"grey", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{1.0}}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 4.0, true), scenes::square("ceiling", {0, 0, 2}, 4.0, false)};
  const glm::dvec3 half{0.4, 0.1, 0.08};
  std::vector<glm::dvec3> middles;
  for (int k = 0; k < 16; ++k) {
    middles.push_back({-1.5 + k % 4, -1.5 + k / 4, 2.0});
    scene.objects.push_back(scenes::object("lamp", scenes::box(middles.back() - half, middles.back() + half), 1));
  }
  scenes::World world{scene};
  std::vector<Color> emission;
  for (const radiosity::InputSurface& s : radiosity::surfaces(world.scene)) {
    emission.push_back(world.scene.materials[s.material].emission);
  }
  world.light = radiosity::DirectLight{world.prepared->objects, world.prepared->surfaces, emission, {.bodies = true}};
  const auto of_lamp = [&](const glm::dvec3& middle, const glm::dvec3& x) {  // by the middles of small squares; no lamp hides another
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        if (axis == 2 && side > 0.0) { continue; }
        const int a = (axis + 1) % 3, b = (axis + 2) % 3, steps = 24;
        for (int i = 0; i < steps * steps; ++i) {
          glm::dvec3 y = middle;
          y[axis] += side * half[axis];
          y[a] += half[a] * (2.0 * (i % steps) + 1.0 - steps) / steps;
          y[b] += half[b] * (2.0 * (i / steps) + 1.0 - steps) / steps;
          if (y.z > 2.0) { continue; }
          const glm::dvec3 d = y - x;
          const double r2 = glm::dot(d, d), leaves = -side * d[axis];
          sum += leaves > 0.0 ? leaves * d.z / (M_PI * r2 * r2) * 4.0 * half[a] * half[b] / (steps * steps) : 0.0;
        }
      }
    }
    return sum;
  };
  Random random{7, 0x73756e6bull};
  double found = 0.0, truth = 0.0;
  for (int k = 0; k < 24; ++k) {
    const glm::dvec3 x = in_cube(random) * glm::dvec3{2, 2, 0};
    for (const glm::dvec3& middle : middles) { truth += of_lamp(middle, x); }
    found += world.region(x, 0.02).irradiance(world.in_frame(x), {0, 0, 1}).x;
  }
  CHECK(std::abs(found / truth - 1.0) < 0.015);  // by the same points for all lamps, and few of them, single points were .01 to .047 off
}
