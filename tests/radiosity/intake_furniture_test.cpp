// SPDX-License-Identifier: MIT
// The intake: boxes that stand on and against each other. Whichever way their polygons were wound, what the air of the room touches shows
// its front, and nothing shows its back to it. And boxes below a sky, which is seen from inside.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/intake/intake.hpp>

#include "catch.hpp"
#include "radiosity/foreign_rooms.hpp"
#include "radiosity/lattice_furniture.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using furniture::Damage;
using furniture::Furnished;
using furniture::FurnishedMaker;
using furniture::Lattice;
using rooms::number_in;
using rooms::RandomRooms;
using soup::Soup;

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

struct Box {
  glm::dvec3 lo, hi;
};

// A chair whose back rest stands on the rear edge of its seat, a shelf whose boards end at its sides, a partition of two pillars and a
// lintel: each a group of boxes.
std::vector<std::vector<Box>> household() {
  std::vector<Box> chair{{{0.5, 0.5, 0.43}, {0.96, 0.96, 0.47}}, {{0.5, 0.93, 0.47}, {0.96, 0.96, 0.95}}};
  for (const double x : {0.53, 0.89}) {
    for (const double y : {0.53, 0.89}) { chair.push_back({{x, y, 0.0}, {x + 0.04, y + 0.04, 0.43}}); }
  }
  std::vector<Box> shelf{{{2.5, 0.1, 0}, {2.52, 0.4, 2}}, {{3.38, 0.1, 0}, {3.4, 0.4, 2}}, {{2.52, 0.39, 0}, {3.38, 0.4, 2}}};
  for (int i = 0; i < 6; ++i) { shelf.push_back({{2.52, 0.1, 0.396 * i}, {3.38, 0.39, 0.396 * i + 0.02}}); }
  return {chair, shelf, {{{0, 2, 0}, {1, 2.1, 3}}, {{1.9, 2, 0}, {4, 2.1, 3}}, {{1, 2, 2.05}, {1.9, 2.1, 3}}}};
}

}  // namespace

TEST_CASE("intake: a chair, a shelf and a partition with a door show their fronts, whichever way they were wound", "[accuracy]") {
  const unsigned seed = test::seed();
  for (int round = 0; round < 12; ++round) {
    INFO("seed " << seed << ", round " << round);
    std::mt19937 random(seed + static_cast<unsigned>(round));
    soup::Soup soup;
    soup.names = {"room"};
    soup::add_box(soup, glm::dvec3(0.0), {4, 4, 3}, 1, true);
    soup.names.emplace_back("lamp");
    soup.polygon({{1, 1, 2.9}, {1, 1.5, 2.9}, {2, 1.5, 2.9}, {2, 1, 2.9}}, 1);
    for (const std::vector<Box>& thing : household()) {
      soup.names.push_back("thing" + std::to_string(soup.names.size()));
      soup::Soup boxes;
      for (const Box& box : thing) { soup::add_box(boxes, box.lo, box.hi); }
      for (std::size_t f = 0; f < boxes.count(); ++f) {
        std::vector<glm::dvec3> outline = boxes.outline(f);
        if (round % 3 == 1 || (round % 3 == 2 && random() % 2 == 0)) { std::reverse(outline.begin(), outline.end()); }
        soup.polygon(outline);
        std::reverse(outline.begin(), outline.end());
        if (round > 5 && random() % 7 == 0) { soup.polygon(outline); }
      }
    }
    const radiosity::Intake intake = soup.take_in();
    soup::check_sound(soup, intake);
    const std::vector<furniture::SeenPoint> seen{
        {{0.7, 0.7, 0.47}, {0, 0, 1}},   {{0.7, 0.7, 0.43}, {0, 0, -1}}, {{0.7, 0.93, 0.8}, {0, -1, 0}}, {{0.7, 0.96, 0.8}, {0, 1, 0}},
        {{2.9, 0.2, 0.812}, {0, 0, 1}},  {{2.52, 0.2, 1.0}, {1, 0, 0}},  {{3.4, 0.2, 1.0}, {1, 0, 0}},   {{2.9, 0.39, 1.0}, {0, -1, 0}},
        {{1.5, 2.05, 2.05}, {0, 0, -1}}, {{1.9, 2.05, 1.0}, {-1, 0, 0}}, {{1.0, 2.05, 1.0}, {1, 0, 0}},  {{0.5, 2, 1.0}, {0, -1, 0}},
        {{1.5, 2, 2.5}, {0, -1, 0}},     {{3.0, 2.1, 1.0}, {0, 1, 0}}};
    const furniture::Sides sides = furniture::sides_of(intake.objects, seen, 1e-5);
    CHECK(sides.missing == 0);
    CHECK(sides.backs == 0);
  }
}

TEST_CASE("intake: boxes on and against each other show their fronts, whichever way they were wound", "[accuracy]") {
  const unsigned seed = test::seed();
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

// A table on legs without ends, a pillar from floor to ceiling, a bracket from it to the wall: tubes whose ends lie within other faces, far
// from any edge. What is in them is dark.
TEST_CASE("intake: tubes that end on faces show their fronts, whichever way they were wound") {
  const unsigned seed = test::seed();
  for (int round = 0; round < 12; ++round) {
    INFO("seed " << seed << ", round " << round);
    std::mt19937 random(seed + static_cast<unsigned>(round));
    const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
    soup::Soup soup;
    soup.names = {"room"};
    soup::add_box(soup, glm::dvec3(0.0), {4, 4, 3}, 1, true);
    soup.names.emplace_back("lamp");
    soup.polygon({{1, 1, 2.9}, {1, 1.5, 2.9}, {2, 1.5, 2.9}, {2, 1, 2.9}}, 1);
    std::vector<furniture::SeenPoint> seen;
    const bool each = round % 3 == 2;
    const auto tube = [&](const glm::dvec3& lo, const glm::dvec3& hi, glm::length_t axis) {
      if (round % 2 == 0) { soup.names.push_back("tube" + std::to_string(soup.names.size())); }
      soup::Soup box;
      soup::add_box(box, lo, hi);
      const bool turn = round % 3 == 1 || (round % 3 == 0 && random() % 2 == 0);
      for (std::size_t f = 0; f < box.count(); ++f) {
        std::vector<glm::dvec3> outline = box.outline(f);
        const bool end = std::all_of(outline.begin(), outline.end(), [&](const glm::dvec3& p) { return p[axis] == outline[0][axis]; });
        if (end) { continue; }
        if (each ? random() % 2 == 0 : turn) { std::reverse(outline.begin(), outline.end()); }
        soup.polygon(outline);
      }
      for (glm::length_t k = 0; k < 3; ++k) {
        for (const double side : {-1.0, 1.0}) {
          if (k == axis) { continue; }
          furniture::SeenPoint point{0.5 * (lo + hi) + glm::dvec3(0.01, -0.03, 0.02) * (hi - lo), glm::dvec3(0.0)};
          point.position[k] = side > 0.0 ? hi[k] : lo[k];
          point.normal[k] = side;
          seen.push_back(point);
        }
      }
    };
    const double top = number(0.5, 1.0), x = number(0.5, 1.5), y = number(0.5, 1.5), thick = number(0.04, 0.12);
    soup.names.emplace_back("top");
    soup::add_box(soup, {x, y, top}, {x + 1.2, y + 0.8, top + 0.05});
    for (const double u : {0.05, 1.0}) {
      for (const double v : {0.05, 0.6}) { tube({x + u, y + v, 0}, {x + u + thick, y + v + thick, top}, 2); }
    }
    const double pillar = number(2.9, 3.2);
    tube({pillar, 3, 0}, {pillar + 0.3, 3.3, 3}, 2);
    tube({pillar + 0.3, 3.1, 1.5}, {4, 3.2, 1.6}, 0);
    const radiosity::Intake intake = soup.take_in();
    soup::check_sound(soup, intake);
    const furniture::Sides sides = furniture::sides_of(intake.objects, seen, 1e-5);
    CHECK(sides.missing == 0);
    CHECK(sides.backs == 0);
  }
}

// As programs write them that make an object of each material.
TEST_CASE("intake: a thing of several groups is the solid that it is in one, and buries what it stands on") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  rooms::RandomRooms random(seed);
  for (int round = 0; round < 8; ++round) {
    soup::Soup parted = rooms::furnished_room(random, round % 4 > 1, 0.1), whole;
    whole = parted;
    const glm::dvec3 lo{rooms::number_in(random, 0.9, 1.1), rooms::number_in(random, 1.1, 1.2), 0.0};
    soup::Soup cabinet;
    soup::add_box(cabinet, lo, lo + glm::dvec3(0.4, 0.5, rooms::number_in(random, 0.3, 1.5)));
    const std::uint32_t doors = static_cast<std::uint32_t>(whole.names.size());
    for (soup::Soup* const s : {&parted, &whole}) {
      s->names.insert(s->names.end(), {"cabinet"});
      if (s == &parted) { s->names.emplace_back("doors"); }
      for (std::size_t f = 0; f < cabinet.count(); ++f) {
        std::vector<glm::dvec3> outline = cabinet.outline(f);
        if (round % 2 == 1) { std::reverse(outline.begin(), outline.end()); }
        s->polygon(outline);
        s->group.back() = s == &parted && f % 5 == 0 ? doors + 1 : doors;
      }
    }
    const radiosity::Intake one = whole.take_in(), several = parted.take_in();
    soup::check_sound(parted, several);
    CHECK(soup::measure(several.objects).solids == soup::measure(one.objects).solids);
    CHECK(soup::measure(several.objects).volume == Approx(soup::measure(one.objects).volume).epsilon(1e-12));
    CHECK(std::any_of(several.objects.begin(), several.objects.end(), [](const auto& o) { return o.name == "doors+cabinet"; }));
    CHECK(several.parts.first == one.parts.first);
  }
}

// A program that reversed some of its polygons at random has turned small boxes as a whole.
TEST_CASE("intake: a sky around boxes is a room though a third of the boxes look inwards") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 20; ++round) {
    const int boxes = 3 + static_cast<int>(random() % 6), inwards = static_cast<int>(random() % static_cast<unsigned>(boxes / 3 + 1));
    Soup sky;
    constexpr int around = 12, along = 6;
    const auto at = [&](int i, int k) {
      const double down = std::numbers::pi * i / along, angle = 2.0 * std::numbers::pi * (k % around) / around;
      return 50.0 * glm::dvec3(std::sin(down) * std::cos(angle), std::sin(down) * std::sin(angle), std::cos(down));
    };
    for (int i = 0; i < along; ++i) {
      for (int k = 0; k < around; ++k) {
        if (i > 0) { sky.polygon({at(i, k), at(i, k + 1), at(i + 1, k)}); }
        if (i + 1 < along) { sky.polygon({at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)}); }
      }
    }
    for (int b = 0; b < boxes; ++b) {
      sky.names.push_back("box" + std::to_string(b));
      const glm::dvec3 lo{4.0 * b - 16.0, number_in(random, -8.0, 8.0), 0.0};
      soup::add_box(sky, lo, lo + glm::dvec3(number_in(random, 1.0, 3.0)), 1, b < inwards);
    }
    const radiosity::Intake intake = sky.take_in();
    CAPTURE(round, boxes, inwards);
    CHECK(soup::measure(intake.objects).rooms == 1);
    CHECK(soup::count_of(intake, radiosity::ChangeKind::inside_out) == static_cast<std::size_t>(inwards));
  }
}
