// SPDX-License-Identifier: MIT

// Chains of nearly identical objects, each within the contact tolerance of the next, the first and the last far beyond it: at every place
// one of them is seen, and the light around is as with the outermost alone.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/box.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/hierarchy/twins.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

using radiosity::Color;
using radiosity::Random;
using radiosity::Scene;

namespace {

// A room of 4 x 3 x 2.5 with a lamp under its ceiling, and things that are put into it.
Scene room() {
  Scene scene{{{"wall", Color{0.7}, Color{0.0}}, {"lamp", Color{0.0}, Color{10.0}}}, {}};
  scene.objects = {scenes::object("room", raycast::BoxObject::make({0, 0, 0}, {4, 3, 2.5}).object, 0, true),
                   scenes::plate("lamp", {{1.5, 1, 2.4}, {1.5, 2, 2.4}, {2.5, 2, 2.4}, {2.5, 1, 2.4}}, 1)};
  return scene;
}

radiosity::SceneObject thing(int kind, double offset, const glm::dvec3& aside) {
  const glm::dvec3 c = glm::dvec3{3, 1.5, 0.8} + aside;
  if (kind == 0) { return scenes::object("thing", raycast::Sphere::make(c, 0.5 - offset).object, 0); }
  return scenes::object("thing", raycast::BoxObject::make(c - (0.5 - offset), c + (0.5 - offset)).object, 0);
}

// Some of them smaller by a step each, or moved by it, in any order; the outermost is first in the list of offsets.
Scene chain(Random& random, Scene& outermost) {
  const int kind = random.uniform() < 0.5 ? 0 : 1, count = 2 + static_cast<int>(5.0 * random.uniform());
  const double step = 1e-9 * std::pow(10.0, -1.0 + 1.5 * random.uniform());
  const bool moved = random.uniform() < 0.4;
  std::vector<radiosity::SceneObject> things;
  for (int k = 0; k < count; ++k) { things.push_back(thing(kind, moved ? 0.0 : k * step, {moved ? k * step : 0.0, 0.0, 0.0})); }
  outermost = room();
  outermost.objects.push_back(things.front());
  for (std::size_t k = things.size() - 1; k > 0; --k) {
    std::swap(things[k], things[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
  }
  Scene scene = room();
  for (std::size_t k = 0; k < things.size(); ++k) {
    things[k].name += std::to_string(k);
    scene.objects.push_back(things[k]);
  }
  return scene;
}

}  // namespace

TEST_CASE("near duplicates: none is left out for one that is left out itself") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Random random{seed, 1};
  for (int trial = 0; trial < 30; ++trial) {
    Scene outermost;
    const auto result = radiosity::prepare(chain(random, outermost));
    REQUIRE(result.prepared);
    const auto pairs = radiosity::twins(result.prepared->surfaces);
    for (const auto& a : pairs) {
      CHECK(a[0] < a[1]);
      CHECK(std::none_of(pairs.begin(), pairs.end(), [&](const auto& b) { return b[0] == a[1]; }));
    }
  }
}

TEST_CASE("near duplicates: rays meet one that is not covered, at the place of the outermost") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Random random{seed, 2};
  for (int trial = 0; trial < 60; ++trial) {
    Scene outermost;
    const Scene scene = chain(random, outermost);
    const auto all = radiosity::prepare(scene), one = radiosity::prepare(outermost);
    REQUIRE((all.prepared && one.prepared));
    const raycast::Scene &many = all.prepared->objects, &single = one.prepared->objects;
    for (int k = 0; k < 200; ++k) {
      const glm::dvec3 eye{0.2 + random.uniform(), 0.2 + 2.6 * random.uniform(), 0.2 + 2.0 * random.uniform()};
      const glm::dvec3 to = glm::dvec3{3, 1.5, 0.8} + glm::dvec3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
      const auto& frame = one.prepared->frame;
      const raycast::Segment ray{(eye - frame.centre) * frame.scale, 2.0 * (to - eye) * frame.scale};
      const auto hit = many.closest(ray), expected = single.closest(ray);
      REQUIRE((hit && expected));
      if (expected->object != 2) { continue; }
      const auto at = many.object(hit->object).project(hit->sheet, ray.at(hit->t));
      const auto wanted = single.object(2).project(expected->sheet, ray.at(expected->t));
      CAPTURE(trial, k, hit->object);
      CHECK(hit->object >= 2);
      CHECK_FALSE(many.covered(at.position, at.normal, hit->object));
      // Seven steps of 3.2e-9 at most, across a surface that the ray may graze.
      CHECK(std::abs(glm::dot(wanted.normal, at.position - wanted.position)) <= 3e-8);
    }
  }
}

TEST_CASE("near duplicates: the floor is as bright as with the outermost alone", "[slow]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Random random{seed, 3};
  for (int trial = 0; trial < 8; ++trial) {
    Scene outermost;
    const Scene scene = chain(random, outermost);
    const radiosity::Options options{.audit_points = 0, .threads = 1};
    const auto floor = [&](const Scene& of) {
      const radiosity::Solution solution = scenes::solved(of, options);
      double light = 0.0, area = 0.0;
      for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
        const radiosity::Node& node = solution.hierarchy[i];
        if (!node.leaf() || node.object != 0 || !(solution.area[i] > 0.0)) { continue; }
        light += solution.area[i] * solution.radiosity[i].x;
        area += solution.area[i];
      }
      return light / area;
    };
    CAPTURE(trial);
    CHECK(floor(scene) == test::Approx(floor(outermost)).epsilon(0.01));  // both are meshed on their own, to about 1 %
  }
}
