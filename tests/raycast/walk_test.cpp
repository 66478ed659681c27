// SPDX-License-Identifier: MIT
// The walk and the builder under all searches (raycast/walk.hpp, raycast/bvh_builder.hpp): laws that hold for any boxes.

#include "catch.hpp"
#include "seed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/bvh_builder.hpp>
#include <raycast/compiled.hpp>
#include <raycast/line_query.hpp>
#include <raycast/point_query.hpp>
#include <raycast/ray.hpp>
#include <raycast/walk.hpp>

namespace {

using raycast::Box;
using raycast::Bvh;
using Boxes = std::vector<Box>;

// Boxes that make trees of every kind: anywhere; all equal; each half as far from the origin as the one before, which the heuristic peels
// off in few at a time; each around the one before, with equal centres.
std::vector<Boxes> families(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-1.0, 1.0), size(0.0, 0.1);
  std::vector<Boxes> result(4);
  for (int i = 0; i < 700; ++i) {
    Box box;
    box.extend(glm::dvec3(place(random), place(random), place(random)));
    result[0].push_back(box.grown(size(random)));
    result[1].push_back(Box{glm::dvec3(0.0), glm::dvec3(1.0)});
    const double far = std::ldexp(1.0, -i), half = 0.1 * far;
    result[2].push_back(Box{glm::dvec3(far - half, -half, -half), glm::dvec3(far + half, half, half)});
    result[3].push_back(Box{glm::dvec3(-far), glm::dvec3(far)});
  }
  return result;
}

std::size_t depth(const Bvh& bvh, std::uint32_t node) {
  const Bvh::Node& at = bvh.nodes()[node];
  return at.count ? 0 : 1 + std::max(depth(bvh, at.first), depth(bvh, at.first + 1));
}

TEST_CASE("a tree holds each item once, within its box, behind its parent, and is no deeper than the stack of a walk") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  for (const Boxes& boxes : families(random)) {
    const Bvh bvh(boxes);
    CHECK(depth(bvh, 0) <= raycast::tree_depth_limit);
    std::vector<int> seen(boxes.size(), 0);
    for (std::uint32_t n = 0; n < bvh.nodes().size(); ++n) {
      const Bvh::Node& node = bvh.nodes()[n];
      const auto holds = [&](const Box& box) { return node.box.contains(box.lo) && node.box.contains(box.hi); };
      if (node.count == 0) {
        REQUIRE(node.first > n);
        CHECK(holds(bvh.nodes()[node.first].box));
        CHECK(holds(bvh.nodes()[node.first + 1].box));
        continue;
      }
      for (const std::uint32_t item : bvh.items(node)) {
        ++seen[item];
        CHECK(holds(boxes[item]));
      }
    }
    CHECK(std::count(seen.begin(), seen.end(), 1) == static_cast<std::ptrdiff_t>(boxes.size()));
  }
}

// Along an axis the exact answer needs no arithmetic: the line lies within both other slabs, and its interval meets that of the box. Of a
// line that misses two of the three slabs, one comparison of infinite numbers said that it meets the box.
TEST_CASE("a line along an axis meets the boxes around it, and no others") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  const auto place = [&] { return static_cast<double>(random() % 9) - 4.0; };  // many equal coordinates
  std::size_t met = 0;
  for (int k = 0; k < 20'000; ++k) {
    Box box;
    box.extend({place(), place(), place()});
    box.extend({place(), place(), place()});
    const int axis = static_cast<int>(random() % 3);
    raycast::Segment line{{place(), place(), place()}, glm::dvec3(random() % 2 == 0 ? 0.0 : -0.0)};
    line.direction[axis] = random() % 2 == 0 ? 1.0 : -1.0;
    const bool whole = random() % 2 == 0;
    const double t0 = whole ? -raycast::infinity : place(), t1 = whole ? raycast::infinity : t0 + static_cast<double>(random() % 4);
    bool wanted = true;
    for (int other = 0; other < 3; ++other) {
      if (other != axis) { wanted = wanted && line.origin[other] >= box.lo[other] && line.origin[other] <= box.hi[other]; }
    }
    const double a = (box.lo[axis] - line.origin[axis]) * line.direction[axis],
                 b = (box.hi[axis] - line.origin[axis]) * line.direction[axis];
    wanted = wanted && std::max(std::min(a, b), t0) <= std::min(std::max(a, b), t1);
    double entry = 0.0;
    CAPTURE(k, axis, t0, t1, box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z, line.origin.x, line.origin.y, line.origin.z);
    REQUIRE(raycast::SlabTest(line)(box, t0, t1, entry) == wanted);
    met += wanted ? 1 : 0;
  }
  CHECK(met > 1000);
}

TEST_CASE("a search finds what asking every box finds, whatever the tree, and stops when it is told to") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (const Boxes& boxes : families(random)) {
    const Bvh bvh(boxes);
    for (int k = 0; k < 50; ++k) {
      const raycast::Segment line{{place(random), place(random), place(random)}, {place(random), place(random), place(random)}};
      const raycast::SlabTest slabs(line);
      std::vector<std::uint32_t> met, wanted;
      const auto meets = [&](std::uint32_t item) {
        double entry = 0.0;
        return slabs(boxes[item], 0.0, 1.0, entry);
      };
      CHECK_FALSE(raycast::any_along(bvh, slabs, 0.0, 1.0, [&](std::uint32_t item) {
        if (meets(item)) { met.push_back(item); }
        return false;
      }));
      for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (meets(i)) { wanted.push_back(i); }
      }
      std::sort(met.begin(), met.end());
      CHECK(met == wanted);
      int visits = 0;
      CHECK(raycast::any_along(bvh, slabs, 0.0, 1.0, [&](std::uint32_t item) { return ++visits, meets(item); }) == !wanted.empty());
      CHECK(visits <= static_cast<int>(boxes.size()));
    }
  }
}

TEST_CASE("what is put off comes back by distance, nearest first, above what lay there before") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  struct Open {
    std::uint32_t child;
    int at;
  };
  for (int k = 0; k < 200; ++k) {
    raycast::PutOff<raycast::Compiled, Open> put_off;
    put_off.push({99, -1});
    std::vector<int> wanted;
    for (std::uint32_t i = 0; i < 8; ++i) {
      wanted.push_back(static_cast<int>(random() % 5));
      put_off.push_sorted(1, {i, wanted.back()});
    }
    std::sort(wanted.begin(), wanted.end());
    for (const int at : wanted) { CHECK(put_off.pop().at == at); }
    CHECK(put_off.pop().child == 99);
    CHECK(put_off.empty());
  }
}

}  // namespace

// On a grid of integers, where the corners of boxes often coincide.
TEST_CASE("two boxes meet where they have a point in common, and one contains another where it has all its points") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> place(0, 4);
  const auto corner = [&] { return glm::dvec3(place(random), place(random), place(random)); };
  for (int round = 0; round < 5000; ++round) {
    Box a, b;
    for (Box* const box : {&a, &b}) {
      box->extend(corner());
      box->extend(corner());
    }
    bool common = false, all = true;
    for (int i = 0; i < 125; ++i) {
      const glm::dvec3 p(i % 5, i / 5 % 5, i / 25);
      common = common || (a.contains(p) && b.contains(p));
      all = all && (a.contains(p) || !b.contains(p));
    }
    CHECK(a.meets(b) == common);
    CHECK(b.meets(a) == common);
    CHECK(a.contains(b) == all);
    CHECK(a.meets(b, 1.0) == a.grown(1.0).meets(b));
    CHECK_FALSE(a.meets(Box()));
  }
}
