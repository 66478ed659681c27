// SPDX-License-Identifier: MIT

// The leaf at a point of a surface is the one that holds it.

#include <cstddef>
#include <cstdint>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>

#include <radiosity/visibility/leaf_locator.hpp>

#include "catch.hpp"
#include "roots.hpp"
#include "scenes.hpp"
#include "seed.hpp"

using roots::closed_room;
using roots::leaves_of;
using roots::roots_of;
using roots::split_at_random;

TEST_CASE("the leaf at a point of a flat surface is the leaf that holds it") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const radiosity::Scene scene = closed_room(
      {scenes::object("box", scenes::box({0.1, 0.2, 0.1}, {0.4, 0.5, 0.3})),
       scenes::plate("L", {{0.5, 0.5, 0.2}, {0.9, 0.5, 0.2}, {0.9, 0.6, 0.2}, {0.6, 0.6, 0.2}, {0.6, 0.9, 0.2}, {0.5, 0.9, 0.2}}),
       scenes::plate("triangle", {{0.5, 0.1, 0.5}, {0.9, 0.1, 0.5}, {0.5, 0.4, 0.6}})});
  const auto discrete = roots_of(scene);
  split_at_random(*discrete, random, 300);
  discrete->patches.extend(1);
  const radiosity::LeafLocator locator{discrete->hierarchy, discrete->patches, discrete->inputs.size()};
  std::uniform_real_distribution<> unit;
  for (const std::uint32_t leaf : leaves_of(*discrete)) {
    const radiosity::Patch& patch = discrete->patches[leaf];
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 x = radiosity::sample(patch, unit(random), unit(random));
      CHECK(locator(discrete->hierarchy[leaf].surface, {x, {}}) == leaf);
    }
  }
}

TEST_CASE("the leaf at a point of a curved surface is the one that the point stands on, or beside its edge a neighbour") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const radiosity::Scene scene =
      closed_room({scenes::object("sphere", raycast::Sphere::make({0.3, 0.3, 0.4}, 0.2).object),
                   scenes::object("torus", raycast::Torus::make({0.7, 0.7, 0.4}, {0, 0, 1}, 0.15, 0.05).object),
                   scenes::object("cylinder", raycast::Cylinder::make({0.7, 0.2, 0.1}, {0, 0, 0.5}, 0.1).object)});
  const auto discrete = roots_of(scene);
  split_at_random(*discrete, random, 500);
  discrete->patches.extend(1);
  const radiosity::LeafLocator locator{discrete->hierarchy, discrete->patches, discrete->inputs.size()};
  std::uniform_real_distribution<> unit;
  std::size_t asked = 0, same = 0;
  for (const std::uint32_t leaf : leaves_of(*discrete)) {
    const radiosity::Node& node = discrete->hierarchy[leaf];
    const raycast::PlacedObject& object = discrete->objects.object(node.object);
    const std::uint32_t sheet = node.surface - discrete->surfaces[node.object].first_surface;
    const glm::dvec3 x = radiosity::sample(discrete->patches[leaf], unit(random), unit(random));
    const raycast::SurfacePoint at = object.project(sheet, x);
    const std::uint32_t found = locator(node.surface, at);
    REQUIRE(found < discrete->hierarchy.size());
    const radiosity::Node& other = discrete->hierarchy[found];
    CHECK(other.surface == node.surface);
    CHECK(glm::length(other.centre - at.position) <= 2.0 * (other.radius + node.radius));
    CHECK((other.deviation == 0.0 || glm::dot(other.normal, at.normal) > 0.0));
    ++asked;
    same += found == leaf ? 1 : 0;
  }
  CHECK(static_cast<double>(same) > 0.9 * static_cast<double>(asked));
}
