// SPDX-License-Identifier: MIT

// Laws of casting stored rays: rays for different uses are independent (rays/stored_rays.hpp).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/leaf_locator.hpp>

#include "catch.hpp"
#include "roots.hpp"
#include "seed.hpp"

using roots::closed_room;
using roots::leaves_of;
using roots::roots_of;

// A node gets more rays for links if some of its 16 rays for spacing meet something bright. If its rays for links depended on those, nodes
// that miss a small bright thing by chance would miss it again, and the mean over all nodes would be too low.
TEST_CASE("what rays for links meet does not depend on what rays for spacing have met") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  const radiosity::Scene scene = closed_room({});
  const auto discrete = roots_of(scene);
  discrete->expose();
  const radiosity::LeafLocator locator{discrete->hierarchy, discrete->patches, discrete->inputs.size()};
  // The floor casts. It sees .02 of the lamp, so 16 rays meet it in a fourth of all cases.
  std::vector<std::uint32_t> counts(discrete->hierarchy.size(), 0);
  std::uint32_t floor = radiosity::no_node;
  for (const std::uint32_t i : leaves_of(*discrete)) {
    if (discrete->hierarchy[i].normal.z > 0.5 && radiosity::is_black(discrete->emission[discrete->hierarchy[i].surface])) { floor = i; }
  }
  REQUIRE(floor != radiosity::no_node);
  const auto met = [&](std::uint32_t rays, radiosity::RayUse use) {
    counts[floor] = rays;
    const radiosity::StoredRays cast = radiosity::cast_rays(*discrete, locator, counts, use);
    const auto lamp = [&](const radiosity::StoredRay& ray) {
      return ray.to != radiosity::no_node && !radiosity::is_black(discrete->emission[discrete->hierarchy[ray.to].surface]);
    };
    return static_cast<double>(std::count_if(cast.of(floor).begin(), cast.of(floor).end(), lamp));
  };
  constexpr std::uint32_t rays = 32;
  double after_hits = 0.0, after_misses = 0.0, hits = 0.0, misses = 0.0;
  for (std::uint64_t round = 0; round < 2000; ++round) {
    discrete->seed = seed + round;
    const bool hit = met(16, radiosity::RayUse::spacing) > 0.0;
    (hit ? after_hits : after_misses) += met(rays, radiosity::RayUse::links);
    (hit ? hits : misses) += 1.0;
  }
  REQUIRE(hits > 100.0);
  REQUIRE(misses > 100.0);
  const double mean = (after_hits + after_misses) / (hits + misses);
  CAPTURE(mean, after_hits / hits, after_misses / misses);
  // The numbers of hits vary no more than independent rays would; their difference, if the same rays are counted, is 1 or more.
  const double error = std::sqrt(mean / hits + mean / misses);
  CHECK(std::abs(after_hits / hits - after_misses / misses) <= 4.0 * error);
}
