// SPDX-License-Identifier: MIT
// The intake: boxes that stand on and against each other. Whichever way their polygons were wound, what the air of the room touches shows
// its front, and nothing shows its back to it.

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/intake/intake.hpp>

#include "catch.hpp"
#include "radiosity/lattice_furniture.hpp"

using furniture::Damage;
using furniture::Furnished;
using furniture::FurnishedMaker;
using furniture::Lattice;

namespace {

struct Case {
  const char* what;
  Damage damage;
};

std::vector<Case> damages() {
  std::vector<Case> cases;
  for (int i = 0; i < 4; ++i) {
    Damage sound, all, boxes, each, doubled, rounded;
    for (Damage* const damage : {&sound, &all, &boxes, &each, &doubled, &rounded}) {
      damage->triangles = i % 2 == 1;
      damage->own_groups = i > 1;
    }
    all.all = boxes.per_box = each.each = doubled.each = rounded.each = true;
    doubled.doubled = 0.15;
    rounded.decimals = 6;
    cases.push_back({"as they should be", sound});
    cases.push_back({"all reversed", all});
    cases.push_back({"boxes at random", boxes});
    cases.push_back({"polygons at random", each});
    cases.push_back({"polygons at random, some given again", doubled});
    cases.push_back({"polygons at random, to six digits", rounded});
  }
  return cases;
}

}  // namespace

TEST_CASE("intake: boxes on and against each other show their fronts, whichever way they were wound") {
  const unsigned seed = std::random_device{}();
  constexpr int rounds = 12;
  for (const Case& c : damages()) {
    for (unsigned round = 0; round < rounds; ++round) {
      INFO(c.what << (c.damage.triangles ? ", triangles" : "") << (c.damage.own_groups ? ", each a group" : "") << ", seed " << seed
                  << ", round " << round);
      std::mt19937 random(seed + 977U * round);
      const Lattice lattice(random, 2 + static_cast<int>(round) % 8);
      const Furnished furnished = FurnishedMaker(lattice, random, c.damage).made();
      const radiosity::Intake intake = furnished.soup.take_in();
      soup::check_sound(furnished.soup, intake);
      const furniture::Sides sides = furniture::sides_of(intake.objects, furnished.seen, 1e-4);
      CHECK(sides.missing == 0);
      // What was given for both sides of a wall between a solid and the air may stay so where it cannot be told from a sheet.
      CHECK(sides.backs <= (c.damage.doubled > 0.0 ? furnished.seen.size() / 10 : 0));
    }
  }
}

TEST_CASE("intake: a sheet that was given for both sides, and stands on the edges of others, stays so") {
  // A wall between two rooms, of which one has a lamp; it meets floor, ceiling and walls in edges, and a door leads through it.
  soup::Soup flat;
  flat.names = {"shell"};
  for (const double x : {0.0, 3.0}) {
    soup::Soup half;
    soup::add_box(half, {x, 0, 0}, {x + 3.0, 4, 3}, 1, true);
    for (std::size_t f = 0; f < half.count(); ++f) {
      const std::vector<glm::dvec3> outline = half.outline(f);
      const bool between = std::all_of(outline.begin(), outline.end(), [](const glm::dvec3& p) { return p.x == 3.0; });
      if (!between) { flat.polygon(outline); }
    }
  }
  flat.names.emplace_back("wall");
  std::vector<glm::dvec3> wall{{3, 0, 0}, {3, 3, 0}, {3, 3, 3}, {3, 0, 3}};
  flat.polygon(wall);
  std::reverse(wall.begin(), wall.end());
  flat.polygon(wall);
  flat.names.emplace_back("lamp");
  flat.polygon({{1, 1, 2.9}, {1, 2, 2.9}, {2, 2, 2.9}, {2, 1, 2.9}}, 1);
  const radiosity::Intake intake = flat.take_in();
  soup::check_sound(flat, intake);
  const furniture::Sides sides = furniture::sides_of(intake.objects, {{{3, 1, 1}, {1, 0, 0}}, {{3, 1, 1}, {-1, 0, 0}}}, 1e-6);
  CHECK(sides.missing == 0);
}
