// SPDX-License-Identifier: MIT
// How many rays nodes cast.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/rays/ray_links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/options.hpp>

#include "catch.hpp"
#include "roots.hpp"

using roots::casters_of;
using roots::closed_room;
using roots::roots_of;

namespace {

void split_to(radiosity::DiscreteScene& scene, std::size_t nodes) {
  for (std::uint32_t i = 0; scene.hierarchy.size() < nodes; ++i) {
    if (scene.hierarchy[i].leaf()) { REQUIRE(radiosity::subdivide(scene.surfaces, scene.hierarchy, i, scene.meshing)); }
  }
  scene.expose();
}

}  // namespace

TEST_CASE("what one camera makes important shares some millions of rays, however much it weighs") {
  const auto discrete = roots_of(closed_room({}), 1, 1);
  discrete->expose();
  discrete->control.viewpoint = radiosity::Viewpoint{};
  std::vector<radiosity::Caster> casters = casters_of(*discrete);
  for (radiosity::Caster& caster : casters) { caster.weight = 1e4; }
  const std::vector<std::uint32_t> counts = radiosity::ray_counts(*discrete, casters, 64.0);
  CHECK(std::accumulate(counts.begin(), counts.end(), 0.0) == test::Approx(1u << 22).epsilon(1e-5));  // rounded
  // Where nodes are so many that equal shares would be more, it is the geometric mean of both.
  split_to(*discrete, 70'000);
  casters = casters_of(*discrete);
  const double equal = 512.0 * static_cast<double>(casters.size());
  const std::vector<std::uint32_t> of_many = radiosity::ray_counts(*discrete, casters, 512.0);
  CHECK(std::accumulate(of_many.begin(), of_many.end(), 0.0) == test::Approx(std::sqrt(0x1p22 * equal)).epsilon(0.01));
}

TEST_CASE("nodes that matter little cast 32 rays each, very many of them for a picture a million in all, but 8 each") {
  const auto discrete = roots_of(closed_room({}), 1, 1);
  const auto cast_by_each = [&](std::size_t nodes, bool picture) {
    split_to(*discrete, nodes);
    discrete->control.viewpoint = picture ? std::optional{radiosity::Viewpoint{}} : std::nullopt;
    std::vector<radiosity::Caster> casters = casters_of(*discrete);
    for (radiosity::Caster& caster : casters) { caster.weight = 1e-9; }
    const std::vector<std::uint32_t> counts = radiosity::ray_counts(*discrete, casters, 64.0);
    return *std::max_element(counts.begin(), counts.end());
  };
  CHECK(cast_by_each(1000, true) == 32);
  CHECK(cast_by_each(70'000, false) == 32);
  // Each is rounded, by a thirtieth; 32 would be twice the million.
  CHECK(cast_by_each(70'000, true) * static_cast<double>(casters_of(*discrete).size()) < 1.05 * 0x1p20);
  CHECK(cast_by_each(220'000, true) == 8);
}
