// SPDX-License-Identifier: MIT
// The intake: lamps that lie flush in a ceiling or on a wall, or stick out of a shell, and what a run says whose light is lost.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/radiosity.hpp>

#include "catch.hpp"
#include "radiosity/foreign_rooms.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using radiosity::ChangeKind;
using rooms::check_same_light;
using rooms::furnished_room;
using rooms::light_of;
using rooms::number_in;
using rooms::RandomRooms;
using soup::count_of;
using soup::Soup;

// Which way up such a lamp was given, where rounding has put it, and whether it comes before or after its room in the file: all the same.
TEST_CASE("intake: a lamp that lies flush in a ceiling shines into the room", "[accuracy]") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 8; ++round) {
    const Soup room = furnished_room(random, round % 2 == 1, 0.0);
    const auto wanted = light_of(room, room.take_in());
    const double tolerance = radiosity::IntakeOptions{}.weld * 5.0, size = std::exp(number_in(random, -5.0, 5.0));
    const bool face_up = round % 4 < 2, two_sided = round % 3 == 2;
    // Within the tolerance, or, where it would light the ceiling from below or from behind, within a thousandth of its size, .6 m or more.
    const double far = face_up ? number_in(random, -4e-4, 4e-4) : number_in(random, 0.0, 4e-4);
    // At least a hundredth of the tolerance: what lies there to rounding is not moved.
    const double near = number_in(random, 0.01, 2.0) * (random() % 2 == 0 ? 1.0 : -1.0);
    const double beside = round % 3 == 1 ? far : near * tolerance;
    const std::size_t lamp = room.count() - 1;
    Soup moved;
    moved.names = room.names;
    if (two_sided) { moved.two_sided = {0, 1}; }
    const auto add = [&](std::size_t f) {
      std::vector<glm::dvec3> outline = room.outline(f);
      if (f == lamp && face_up) { std::reverse(outline.begin(), outline.end()); }
      for (glm::dvec3& p : outline) { p = size * (p + glm::dvec3(0, 0, f == lamp ? beside : 0.0)); }
      moved.polygon(outline, room.material[f]);
      moved.group.back() = room.group[f];
    };
    add(lamp);
    for (std::size_t f = 0; f < lamp; ++f) { add(f); }
    const radiosity::Intake taken = moved.take_in();
    soup::check_sound(moved, taken);
    CHECK(count_of(taken, ChangeKind::lamp_turned) == (face_up && !two_sided ? 1 : 0));
    CHECK(count_of(taken, ChangeKind::lamp_laid) > 0);
    CHECK(taken.faces == room.take_in().faces);
    check_same_light(wanted, light_of(moved, taken));
  }
}

TEST_CASE("intake: a lamp that hangs close under a ceiling shines into the room, whichever way up it was given", "[accuracy]") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 8; ++round) {
    const Soup room = furnished_room(random, round % 2 == 1, number_in(random, 0.002, 0.012));  // of a lamp of .6 m or more
    Soup up, high;
    for (std::size_t f = 0; f < room.count(); ++f) {
      std::vector<glm::dvec3> outline = room.outline(f);
      if (room.material[f] == 1) { std::reverse(outline.begin(), outline.end()); }
      up.polygon(outline, room.material[f]);
      for (glm::dvec3& p : outline) { p.z -= room.material[f] == 1 ? 0.3 : 0.0; }
      high.polygon(outline, room.material[f]);
      up.group.back() = high.group.back() = room.group[f];
    }
    up.names = high.names = room.names;
    const radiosity::Intake taken = up.take_in();
    CHECK(count_of(taken, ChangeKind::lamp_turned) == 1);
    CHECK(count_of(room.take_in(), ChangeKind::lamp_turned) == 0);
    CHECK(count_of(high.take_in(), ChangeKind::lamp_turned) == 0);  // it was meant to light the ceiling
    check_same_light(light_of(room, room.take_in()), light_of(up, taken));
  }
}

TEST_CASE("intake: a lamp on a ceiling that is a slab shines into the room, whichever way up it was given", "[accuracy]") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 8; ++round) {
    const glm::dvec3 size{number_in(random, 2, 6), number_in(random, 2, 6), number_in(random, 2, 3)};
    const double thick = number_in(random, 0.05, 0.3), x = 0.5 * number_in(random, 0, size.x), y = 0.5 * number_in(random, 0, size.y);
    const double under = round % 2 == 0 ? 0.0 : number_in(random, 0.0, 4e-4), side = 0.2 * size.x;
    std::array<Soup, 2> rooms;
    for (const bool up : {false, true}) {
      Soup& room = rooms[up ? 1 : 0];
      room.names.clear();
      const auto add_slab = [&](const char* name, const glm::dvec3& lo, const glm::dvec3& hi) {
        room.names.emplace_back(name);
        soup::add_box(room, lo, hi);
      };
      add_slab("floor", {0, 0, -thick}, {size.x, size.y, 0});
      add_slab("ceiling", {0, 0, size.z}, {size.x, size.y, size.z + thick});
      add_slab("west", {-thick, 0, 0}, {0, size.y, size.z});
      add_slab("east", {size.x, 0, 0}, {size.x + thick, size.y, size.z});
      add_slab("north", {0, size.y, 0}, {size.x, size.y + thick, size.z});
      room.names.emplace_back("lamp");
      const double z = size.z - (up ? under : 0.0);
      std::vector<glm::dvec3> lamp{{x, y, z}, {x, y + side, z}, {x + side, y + side, z}, {x + side, y, z}};
      if (up) { std::reverse(lamp.begin(), lamp.end()); }
      room.polygon(lamp, 1);
    }
    const radiosity::Intake down = rooms[0].take_in(), up = rooms[1].take_in();
    CHECK(count_of(up, ChangeKind::lamp_turned) == 1);
    CHECK(count_of(up, ChangeKind::room) == 0);
    check_same_light(light_of(rooms[0], down), light_of(rooms[1], up));
  }
}

TEST_CASE("intake: an empty closed room in whose ceiling a lamp lies is a room, alone, beside others and under others") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 12; ++round) {
    const glm::dvec3 size{number_in(random, 2, 6), number_in(random, 2, 6), number_in(random, 2, 3)};
    const double under = round % 2 == 0 ? 0.0 : number_in(random, 0.0, 4e-4), gap = number_in(random, 0.0, 0.3);
    const int rooms = 1 + round % 3;
    Soup soup;
    soup.names.clear();
    for (int k = 0; k < rooms; ++k) {
      const glm::dvec3 lo = static_cast<double>(k) * (round < 6 ? glm::dvec3(0, 0, size.z + gap) : glm::dvec3(size.x + gap, 0, 0));
      soup.names.push_back("room" + std::to_string(k));
      soup::add_box(soup, lo, lo + size);
      soup.names.push_back("lamp" + std::to_string(k));
      const double x = lo.x + 0.4 * size.x, y = lo.y + 0.4 * size.y, z = lo.z + size.z - under, side = 0.2 * size.x;
      soup.polygon({{x, y, z}, {x, y + side, z}, {x + side, y + side, z}, {x + side, y, z}}, 1);
    }
    CHECK(count_of(soup.take_in(), ChangeKind::room) == static_cast<std::size_t>(rooms));
  }
}

TEST_CASE("intake: a lamp close above a table is not turned away from it where there is nothing else to light") {
  for (const bool in_room : {false, true}) {
    Soup soup;
    soup.names = {"table", "lamp", "room"};
    soup.polygon({{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}});
    soup.polygon({{1.2, 1.2, 1.005}, {1.2, 1.8, 1.005}, {1.8, 1.8, 1.005}, {1.8, 1.2, 1.005}}, 1);  // looks down
    if (in_room) { soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, 1, true); }
    CHECK(count_of(soup.take_in(), ChangeKind::lamp_turned) == (in_room ? 1 : 0));
  }
}

TEST_CASE("intake: a bare room whose lamp is sunk into its ceiling or a wall is seen from inside") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 16; ++round) {
    const bool inwards = round % 2 == 0, sides_told = round % 4 < 2, of_ceiling = round % 8 < 4;
    const glm::dvec3 size{number_in(random, 2.0, 6.0), number_in(random, 2.0, 6.0), number_in(random, 2.0, 3.0)};
    Soup soup;
    soup.names = {"room", "lamp"};
    soup::add_box(soup, {0, 0, 0}, size, 1, inwards);
    glm::dvec3 middle = 0.5 * size;
    const int axis = of_ceiling ? 2 : 0;
    middle[axis] = size[axis] + number_in(random, -0.08, 0.08);  // of a lamp of .2 m
    soup::add_box(soup, middle - 0.1, middle + 0.1, 1, false, 1);
    radiosity::IntakeOptions options{.sides_unknown = !sides_told};
    const radiosity::Intake taken = soup.take_in(options);
    INFO("round " << round);
    const bool room = inwards || !sides_told;  // what is told to look outwards stays a solid, with a lamp on it
    CHECK(taken.rooms.size() == (room ? 1 : 0));
    CHECK(count_of(taken, ChangeKind::inside_out) == 0);
    CHECK(count_of(taken, ChangeKind::room) == (room && !inwards ? 1 : 0));
    options.eyes = {3.0 * size};  // looks at it from outside
    const radiosity::Intake seen_from_outside = soup.take_in(options);
    CHECK(seen_from_outside.rooms.empty());
    CHECK(count_of(seen_from_outside, ChangeKind::inside_out) == (inwards ? 1 : 0));
  }
}

TEST_CASE("intake: a lamp on a wall without a thickness shines to its own side") {
  for (const bool down : {false, true}) {
    Soup soup;
    soup.two_sided = {1, 0};
    soup.names = {"sheet"};
    soup.polygon({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}});
    soup.names.push_back("lamp");
    std::vector<glm::dvec3> lamp{{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}};
    if (down) { std::reverse(lamp.begin(), lamp.end()); }
    soup.polygon(lamp, 1);
    const radiosity::Intake intake = soup.take_in();
    CHECK(count_of(intake, ChangeKind::lamp_turned) == 0);
    CHECK(intake.objects.back().name == "lamp");
    CHECK((intake.objects.back().shape->project(0, {1.5, 1.5, 1}).normal.z > 0.0) != down);
  }
}

TEST_CASE("a run whose light reaches nothing says so") {
  RandomRooms random(3);
  for (const double under : {0.1, -0.1}) {  // the lamp lies above the ceiling
    const Soup room = furnished_room(random, false, under);
    const radiosity::Options options{.epsilon = 0.05, .audit_points = 0};
    const radiosity::IntakeOptions inside{.eyes = {{1, 1, 1}}};
    const radiosity::Outcome outcome = radiosity::solve({room.materials, room.take_in(inside).objects}, options);
    REQUIRE(outcome.solution);
    const std::vector<std::string>& warnings = outcome.solution->audit.warnings;
    const bool said =
        std::any_of(warnings.begin(), warnings.end(), [](const auto& s) { return s.find("reflected by any surface") != s.npos; });
    CHECK(said == (under < 0.0));
  }
}

// Its middle lies in the thing, a part of it outside, and the room holds it whole.
TEST_CASE("intake: a thing out of which a lamp reaches is no room while it stands in one") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 40; ++round) {
    const glm::dvec3 hi{number_in(random, 2.0, 6.0), number_in(random, 2.0, 6.0), number_in(random, 2.0, 4.0)};
    const glm::dvec3 lo = hi * number_in(random, 0.2, 0.4), top = hi * number_in(random, 0.5, 0.7);
    const double far = number_in(random, 0.55, 0.7),
                 near = number_in(random, 0.1, 0.45);  // half the lamp and its width, in those of the thing
    const glm::dvec3 middle = 0.5 * (lo + top), along = (top - lo) * glm::dvec3(far, 0.0, 0.0);
    const glm::dvec3 across = (top - lo) * glm::dvec3(0.0, near, 0.0), start = middle - along - 0.5 * across;
    Soup room;
    room.names = {"room"};
    soup::add_box(room, glm::dvec3(0.0), hi, 1, true);
    room.names.push_back("thing");
    soup::add_box(room, lo, top);
    room.names.push_back("lamp");
    std::vector<glm::dvec3> lamp{start, start + 2.0 * along, start + 2.0 * along + across, start + across};
    room.polygon(lamp, 1);
    if (round % 2 == 0) {
      std::reverse(lamp.begin(), lamp.end());
      room.polygon(lamp, 1);
    }
    const radiosity::Intake taken = room.take_in();
    soup::check_sound(room, taken);
    CHECK(count_of(taken, ChangeKind::room) == 0);
    const soup::Measure measure = soup::measure(taken.objects);
    CHECK(measure.rooms == 1);
    CHECK(measure.solids == 1);
  }
}

TEST_CASE("intake: of an open lamp the report says that its side is a guess, unless the file or what is beside it tells") {
  for (const bool up : {false, true}) {
    for (const double gap : {0.0, 0.005, 0.5}) {  // flush in the ceiling, close below it, and well below it
      for (const bool two_sided : {false, true}) {
        for (const bool unknown : {false, true}) {
          Soup soup;
          soup.names = {"room"};
          soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, 1, true);
          const double z = 3.0 - gap;
          std::vector<glm::dvec3> lamp{{1, 1, z}, {1, 2, z}, {2, 2, z}, {2, 1, z}};  // seen from below
          if (up) { std::reverse(lamp.begin(), lamp.end()); }
          soup.names.emplace_back("lamp");
          soup.polygon(lamp, 1);
          if (two_sided) { soup.two_sided = {0, 1}; }
          radiosity::IntakeOptions options;
          options.open_sides_unknown = unknown;
          const radiosity::Intake taken = soup.take_in(options);
          CAPTURE(up, gap, two_sided, unknown);
          // One that looks into a surface close by is turned, which is told instead.
          const bool turned = up && gap < 0.1 && !two_sided;
          CHECK(count_of(taken, ChangeKind::lamp_turned) == (turned ? 1 : 0));
          const bool guess = unknown && !two_sided && gap > 0.0 && !turned;
          CHECK(count_of(taken, ChangeKind::lamp_front) == (guess ? 1 : 0));
        }
      }
    }
  }
}

// Crystals in a rock, and bulbs in a housing: nearly all of the lamp is in a shell, and some of its faces stick out.
TEST_CASE("intake: whether a shell around a lamp is a room does not depend on the order of the polygons") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int around = 10, along = 8;
  for (int round = 0; round < 20; ++round) {
    const double radius = 0.3 + 0.2 * unit(random), under = radius * (0.6 + 0.39 * unit(random));
    const glm::dvec3 middle{1.0 + unit(random), 1.0 + unit(random), 2.0 - under};
    const auto at = [&](int i, int k) {
      const double down = std::numbers::pi * i / along, angle = 2.0 * std::numbers::pi * (k % around) / around;
      return middle + radius * glm::dvec3(std::sin(down) * std::cos(angle), std::sin(down) * std::sin(angle), std::cos(down));
    };
    Soup soup;
    soup::add_box(soup, {0, 0, 0}, {3, 3, 2}, 2);
    for (int i = 0; i < along; ++i) {
      for (int k = 0; k < around; ++k) {
        if (i > 0) { soup.polygon({at(i, k), at(i + 1, k), at(i, k + 1)}, 1); }
        if (i + 1 < along) { soup.polygon({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)}, 1); }
      }
    }
    const radiosity::Intake expected = soup.take_in();
    for (int variant = 0; variant < 4; ++variant) {
      std::vector<std::size_t> order(soup.count());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::shuffle(order.begin(), order.end(), random);
      Soup shuffled;
      for (const std::size_t f : order) { shuffled.polygon(soup.outline(f), soup.material[f]); }
      const radiosity::Intake intake = shuffled.take_in();
      CAPTURE(round, variant, radius, under);
      CHECK(intake.rooms.size() == expected.rooms.size());
      CHECK(count_of(intake, ChangeKind::room) == count_of(expected, ChangeKind::room));
    }
  }
}
