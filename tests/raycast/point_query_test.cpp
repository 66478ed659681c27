// SPDX-License-Identifier: MIT
#include "catch.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>

namespace {

std::vector<raycast::Box> random_boxes(std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::uniform_real_distribution<double> side(0.0, 0.2);
  std::vector<raycast::Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 lo{place(random), place(random), place(random)};
    boxes.push_back({lo, lo + glm::dvec3{side(random), side(random), side(random)}});
  }
  return boxes;
}

}  // namespace

TEST_CASE("around a point are all boxes that contain it, and the nearest is the one of brute force") {
  constexpr std::uint64_t seed = 11;
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (const std::size_t count : {1u, 2u, 7u, 1000u}) {
    const std::vector<raycast::Box> boxes = random_boxes(random, count);
    const raycast::Bvh bvh(boxes);
    for (int i = 0; i < 1000; ++i) {
      glm::dvec3 p{place(random), place(random), place(random)};
      if (i % 10 == 0) { p = boxes[random() % count].hi; }  // a corner counts as inside
      std::vector<int> met(count, 0);
      raycast::around(bvh, p, [&](std::uint32_t k) { ++met[k]; });
      for (std::size_t k = 0; k < count; ++k) {
        if (boxes[k].contains(p)) { CHECK(met[k] == 1); }
        CHECK(met[k] <= 1);
      }
      const auto squared = [&](std::uint32_t k) { return raycast::squared_distance(boxes[k], p); };
      const auto nearest = raycast::nearest(bvh, p, squared);
      REQUIRE(nearest);
      double least = squared(0);
      for (std::uint32_t k = 1; k < count; ++k) { least = std::min(least, squared(k)); }
      CHECK(squared(*nearest) == least);
    }
  }
  const raycast::Bvh none;
  raycast::around(none, glm::dvec3{0.0}, [](std::uint32_t) { FAIL("nothing is there"); });
  CHECK_FALSE(raycast::nearest(none, glm::dvec3{0.0}, [](std::uint32_t) { return 0.0; }));
}
