// SPDX-License-Identifier: MIT
// The intake: rooms as strangers write them. Walls, floor and ceiling in groups of their own, polygons given again for their back, walls
// with a thickness without a lamp: each must become what the sound model becomes.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/radiosity.hpp>

#include "catch.hpp"
#include "radiosity/foreign_rooms.hpp"
#include "radiosity/lattice_furniture.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using radiosity::ChangeKind;
using rooms::add_ceiling_lamp;
using rooms::add_sides;
using rooms::check_same_light;
using rooms::furnished_room;
using rooms::light_of;
using rooms::number_in;
using rooms::RandomRooms;
using soup::count_of;
using soup::Soup;

TEST_CASE("intake: groups that close a shell together look where one group looks") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 24; ++round) {
    const bool walls = round % 2 == 1;
    const glm::dvec3 hi{number_in(random, 2.0, 6.0), number_in(random, 2.0, 6.0), number_in(random, 2.0, 4.0)};
    Soup soup, whole;
    for (Soup* const s : {&soup, &whole}) {
      s->names = {"lamp"};
      add_ceiling_lamp(*s, glm::dvec3(0.0), hi, 0.1);
    }
    add_sides(soup, random, glm::dvec3(0.0), hi, random() % 2 == 0, true);
    if (walls) { add_sides(soup, random, glm::dvec3(-0.2), hi + 0.2, random() % 2 == 0, true); }
    const radiosity::Intake intake = soup.take_in();
    soup::check_sound(soup, intake);
    whole.names.push_back("room");
    soup::add_box(whole, glm::dvec3(0.0), hi, 1, true);
    if (walls) { soup::add_box(whole, glm::dvec3(-0.2), hi + 0.2); }
    CHECK(soup::measure(intake.objects).area == Approx(soup::measure(whole.take_in().objects).area).epsilon(1e-9));
    REQUIRE(intake.rooms.size() == 1);
    CHECK(intake.rooms[0].within_walls == walls);
    // Each group is one object with its name, and looks into the room, or out of the walls.
    REQUIRE(intake.objects.size() == soup.names.size());
    for (const radiosity::SceneObject& object : intake.objects) {
      INFO(object.name);
      CHECK(std::count(soup.names.begin(), soup.names.end(), object.name) == 1);
      if (object.name == "lamp") { continue; }
      const raycast::SurfacePoint at = object.shape->project(0, object.shape->bounds().centre());
      const bool of_room = std::stoi(object.name.substr(4)) <= 6;
      CHECK((glm::dot(0.5 * hi - at.position, at.normal) > 0.0) == of_room);
    }
  }
}

TEST_CASE("intake: what touches a room or leaves it open joins no shell") {
  RandomRooms random(1);
  const glm::dvec3 hi{4, 4, 3};
  Soup soup;
  soup.names = {"lamp"};
  add_ceiling_lamp(soup, glm::dvec3(0.0), hi, 0.1);
  add_sides(soup, random, glm::dvec3(0.0), hi, true, false);
  Soup open = soup;
  soup.names.push_back("carpet");  // an edge of it is the edge of a wall and the floor
  soup.polygon({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}});
  soup.names.push_back("partition");
  soup.polygon({{2, 0, 0}, {2, 3, 0}, {2, 3, 3}, {2, 0, 3}});
  CHECK(soup.take_in().rooms.size() == 1);

  open.polygon({{1, 1, 1}, {2, 1, 1}, {2, 2, 1}});
  const auto remove_group = [](Soup& from, std::uint32_t group) {
    Soup left;
    left.names = from.names;
    for (std::size_t f = 0; f < from.count(); ++f) {
      if (from.group[f] == group) { continue; }
      left.polygon(from.outline(f), from.material[f]);
      left.group.back() = from.group[f];
    }
    return left;
  };
  const Soup without = remove_group(open, 3);
  CHECK(without.take_in().rooms.empty());
  CHECK(count_of(without.take_in(), ChangeKind::turned) == 0);
}

TEST_CASE("intake: polygons given again for their back change no light", "[accuracy]") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 6; ++round) {
    const bool all = round % 3 == 2;
    const Soup room = furnished_room(random, round % 2 == 1, round < 3 ? 0.1 : 0.0);
    Soup doubled = room;
    for (std::size_t f = 0; f < room.count(); ++f) {
      if (!all && random() % 3 != 0) { continue; }
      std::vector<glm::dvec3> outline = room.outline(f);
      if (room.material[f] == 1 && round < 3) { continue; }  // a lamp that hangs free would shine twice as much
      std::reverse(outline.begin(), outline.end());
      doubled.polygon(outline, room.material[f]);
      doubled.group.back() = room.group[f];
    }
    const radiosity::Intake sound = room.take_in(), taken = doubled.take_in();
    soup::check_sound(doubled, taken);
    CHECK(taken.faces == sound.faces);
    CHECK(count_of(taken, ChangeKind::nonmanifold) == 0);
    CHECK(count_of(taken, ChangeKind::duplicate) == doubled.count() - room.count());
    check_same_light(light_of(room, sound), light_of(doubled, taken));
    for (std::size_t f = room.count(); f < doubled.count(); ++f) {  // each knows where its light is, and that it shows the other side
      REQUIRE(taken.parts.of(f).size() == 1);
      CHECK(taken.parts.of(f)[0].back);
    }
  }
}

TEST_CASE("intake: backs that were cut along the other diagonal change no light either") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 4; ++round) {
    const Soup room = furnished_room(random, round % 2 == 1, 0.0);
    Soup doubled = room;
    for (std::size_t f = 0; f + 1 < room.count(); f += 2) {  // 0 1 2 and 0 2 3
      if (round > 1 && random() % 3 != 0) { continue; }
      const glm::dvec3 a = room.outline(f)[0], b = room.outline(f)[1], c = room.outline(f)[2], d = room.outline(f + 1)[2];
      for (const std::vector<glm::dvec3>& outline : {std::vector{b, a, d}, std::vector{d, c, b}}) {
        doubled.polygon(outline, room.material[f]);
        doubled.group.back() = room.group[f];
      }
    }
    const radiosity::Intake sound = room.take_in(), taken = doubled.take_in();
    soup::check_sound(doubled, taken);
    CHECK(taken.faces == sound.faces);
    CHECK(count_of(taken, ChangeKind::nonmanifold) == 0);
    check_same_light(light_of(room, sound), light_of(doubled, taken));
    Soup sheet;  // open
    const std::vector<glm::dvec3> c{{0, 0, 0}, {number_in(random, 1.0, 2.0), 0, 0}, {1, 1, 0}, {0, number_in(random, 0.6, 1.4), 0}};
    for (const auto& [i, j, k] : {std::array{0, 1, 2}, std::array{0, 2, 3}, std::array{1, 0, 3}, std::array{3, 2, 1}}) {
      sheet.polygon({c[static_cast<std::size_t>(i)], c[static_cast<std::size_t>(j)], c[static_cast<std::size_t>(k)]});
    }
    CHECK(sheet.take_in().faces == 2);
    CHECK(soup::measure(sheet.take_in().objects).area == Approx(sheet.area()).epsilon(1e-9));
    for (std::size_t f = 0; f < doubled.count(); ++f) {
      REQUIRE(taken.parts.of(f).size() == 1);
      CHECK(taken.parts.of(f)[0].back == (f >= room.count()));
    }
  }
}

TEST_CASE("intake: a tetrahedron is a solid, however flat it is") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 200; ++round) {
    // Over a quadrilateral whose diagonals cross, the fourth corner above the plane of the others: two faces look up, two down.
    const double height = std::pow(10.0, number_in(random, -3.0, 0.0));
    const std::array<glm::dvec3, 4> at{glm::dvec3(0, 0, 0), glm::dvec3(number_in(random, 0.7, 1.3), number_in(random, -0.2, 0.2), 0),
                                       glm::dvec3(number_in(random, 0.7, 1.3), number_in(random, 0.7, 1.3), height),
                                       glm::dvec3(number_in(random, -0.2, 0.2), number_in(random, 0.7, 1.3), 0)};
    Soup tetrahedron;
    for (const auto& [i, j, k] : {std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{1, 0, 2}, std::array{3, 2, 0}}) {
      std::array<glm::dvec3, 3> face{at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)], at[static_cast<std::size_t>(k)]};
      tetrahedron.polygon({face.begin(), face.end()});
    }
    const radiosity::Intake taken = tetrahedron.take_in();
    const soup::Measure m = soup::measure(taken.objects);
    CAPTURE(round, height);
    CHECK(m.solids == 1);
    CHECK(taken.faces == 4);
    const double volume = std::abs(glm::dot(at[1] - at[0], glm::cross(at[2] - at[0], at[3] - at[0]))) / 6.0;
    CHECK(m.volume == Approx(volume).epsilon(1e-5));  // vertices may be moved by a millionth
  }
}

TEST_CASE("intake: a curtain of bent quadrilaterals, each side cut along another diagonal, is a sheet with two sides") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 20; ++round) {
    std::vector<glm::dvec3> at;
    for (int i = 0; i < 16; ++i) { at.emplace_back(i % 4, 0.1 * number_in(random, -1.0, 1.0), i / 4); }
    Soup front, back, both;
    for (std::size_t i = 0; i < 9; ++i) {
      const std::size_t a = i / 3 * 4 + i % 3, b = a + 1, c = a + 5, d = a + 4;
      for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{a, c, d}}) {
        front.polygon({at[p], at[q], at[r]});
        both.polygon({at[p], at[q], at[r]});
      }
      for (const auto& [p, q, r] : {std::array{d, c, b}, std::array{d, b, a}}) {
        back.polygon({at[p], at[q], at[r]});
        both.polygon({at[p], at[q], at[r]});
      }
    }
    const radiosity::Intake taken = both.take_in();
    // Neighbours that happen to be coplanar are one face, on the side that is kept.
    CHECK((taken.faces == 2 * front.take_in().faces || taken.faces == 2 * back.take_in().faces));
    CHECK(soup::measure(taken.objects).solids == 0);
  }
}

TEST_CASE("intake: solids that share a face, each with its own, stay solids") {
  Soup boxes;
  soup::add_box(boxes, {0, 0, 0}, {1, 1, 1});
  soup::add_box(boxes, {1, 0, 0}, {2, 1, 1});
  soup::add_box(boxes, {0, 0, 1}, {1, 1, 2});
  const soup::Measure m = soup::measure(boxes.take_in().objects);
  CHECK(m.solids == 3);
  CHECK(m.volume == Approx(3.0).epsilon(1e-12));
}

TEST_CASE("intake: a sheet whose sides have two materials keeps both") {
  for (const bool turned : {false, true}) {
    Soup sheet;
    sheet.materials.push_back({"white", glm::dvec3(0.9), glm::dvec3(0.0)});
    std::vector<glm::dvec3> outline{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    sheet.polygon(outline, turned ? 2 : 0);
    std::reverse(outline.begin(), outline.end());
    sheet.polygon(outline, turned ? 0 : 2);
    const radiosity::Intake intake = sheet.take_in();
    REQUIRE(intake.objects.size() == 2);
    for (const radiosity::SceneObject& object : intake.objects) {
      const bool up = object.shape->project(0, {0.5, 0.5, 0}).normal.z > 0.0;
      CHECK(object.material[0] == (up != turned ? 0U : 2U));
    }
  }
}

// No lamp and no eye tells which side is seen; what is in what does.
TEST_CASE("intake: walls of a thickness hold rooms, and a room inside out holds things") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 16; ++round) {
    const bool flipped = round % 2 == 1, two = round % 4 > 1;
    const glm::dvec3 hi{number_in(random, 3.0, 6.0), number_in(random, 3.0, 6.0), number_in(random, 2.5, 4.0)};
    const double thick = number_in(random, 0.05, 0.2);
    Soup house;
    soup::add_box(house, glm::dvec3(0.0), hi, 1, !flipped);
    if (two) { soup::add_box(house, {hi.x + thick, 0, 0}, {2.0 * hi.x, hi.y, hi.z}, 1, !flipped); }
    soup::add_box(house, glm::dvec3(-thick), glm::dvec3((two ? 2.0 : 1.0) * hi.x, hi.y, hi.z) + thick, 1, flipped);
    if (round % 8 < 4) { soup::add_box(house, 0.1 * hi, 0.4 * hi, 1, flipped); }
    const radiosity::Intake intake = house.take_in();
    soup::check_sound(house, intake);
    REQUIRE(intake.rooms.size() == (two ? 2 : 1));
    for (const radiosity::Room& room : intake.rooms) { CHECK(room.within_walls); }
    const soup::Measure m = soup::measure(intake.objects);
    const double rooms = hi.x * hi.y * hi.z + (two ? (hi.x - thick) * hi.y * hi.z : 0.0);
    const double outer = ((two ? 2.0 : 1.0) * hi.x + 2.0 * thick) * (hi.y + 2.0 * thick) * (hi.z + 2.0 * thick);
    CHECK(m.volume == Approx(outer - rooms + (round % 8 < 4 ? 0.027 * hi.x * hi.y * hi.z : 0.0)).epsilon(1e-9));
    CHECK(m.rooms == 0);

    Soup room;  // without walls
    soup::add_box(room, glm::dvec3(0.0), hi, 1, !flipped);
    soup::add_box(room, 0.1 * hi, 0.4 * hi, 1, flipped);
    soup::add_box(room, 0.6 * hi, 0.9 * hi, 1, flipped);
    CHECK(soup::measure(room.take_in().objects).rooms == 1);
    CHECK(soup::measure(room.take_in().objects).solids == 2);
  }
  // A bottle and what is in it, which both look outwards, are seen from outside.
  Soup bottle;
  soup::add_box(bottle, {0, 0, 0}, {1, 1, 3});
  soup::add_box(bottle, {0.1, 0.1, 0.1}, {0.9, 0.9, 2.5});
  CHECK(bottle.take_in().rooms.empty());
}

// Lamps let into a ceiling or a wall stick out beyond it, and no camera is known: what is in the room tells that it is one.
TEST_CASE("intake: a furnished room through whose walls lamps reach is a room, whichever way all was wound") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 16; ++round) {
    const bool flipped = round % 2 == 1, walls = round % 4 > 1;
    const glm::dvec3 hi{number_in(random, 3.0, 6.0), number_in(random, 3.0, 6.0), number_in(random, 2.5, 4.0)};
    Soup room;
    room.names = {"room"};
    soup::add_box(room, glm::dvec3(0.0), hi, 1, !flipped);
    if (walls) { soup::add_box(room, glm::dvec3(-0.2), hi + 0.2, 1, flipped); }
    for (int i = 0; i < 3; ++i) {
      room.names.push_back("lamp" + std::to_string(i));
      const glm::dvec3 lo{0.2 + 0.25 * i * hi.x, number_in(random, 0.5, 1.5), hi.z - number_in(random, 0.02, 0.1)};
      soup::add_box(room, lo, lo + glm::dvec3(0.2, 0.3, 0.12), 1 + i, flipped, 1);
    }
    room.names.emplace_back("thing");
    soup::add_box(room, 0.1 * hi, glm::dvec3(0.25, 0.3, number_in(random, 0.2, 0.7)) * hi, 1, flipped);
    const radiosity::Intake intake = room.take_in();
    soup::check_sound(room, intake);
    REQUIRE(intake.rooms.size() == 1);
    CHECK(intake.rooms[0].within_walls == walls);
    const std::vector<furniture::SeenPoint> seen{{{0, 0.5 * hi.y, 0.5 * hi.z}, {1, 0, 0}}, {0.5 * hi * glm::dvec3(1, 1, 0), {0, 0, 1}}};
    const furniture::Sides sides = furniture::sides_of(intake.objects, seen, 1e-6);
    CHECK(sides.missing == 0);
    CHECK(sides.backs == 0);
  }
}

// The lamp is a face of the room's own shell, which three groups close together.
TEST_CASE("intake: a furnished room with a shining face in its shell is a room, whichever way its groups were wound") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 16; ++round) {
    const glm::dvec3 hi{number_in(random, 3.0, 6.0), number_in(random, 3.0, 6.0), number_in(random, 2.5, 4.0)};
    Soup sides;
    add_sides(sides, random, glm::dvec3(0.0), hi, random() % 2 == 0, true);
    Soup soup;
    soup.names = sides.names;
    for (std::size_t f = 0; f < sides.count(); ++f) {
      soup.polygon(sides.outline(f), sides.group[f] == 6 ? 1 : 0);
      soup.group.back() = sides.group[f];
    }
    for (int i = 0; i < 4; ++i) {  // of both orientations
      soup.names.push_back("thing" + std::to_string(i));
      const glm::dvec3 lo{0.2 + 0.7 * i, number_in(random, 0.5, 1.5), 0.2};
      soup::add_box(soup, lo, lo + glm::dvec3(0.3, 0.3, 0.5), 1, i % 2 == 0);
    }
    const radiosity::Intake intake = soup.take_in();
    soup::check_sound(soup, intake);
    CHECK(intake.rooms.size() == 1);
    for (const radiosity::SceneObject& object : intake.objects) {
      if (!object.name.starts_with("side")) { continue; }
      const raycast::SurfacePoint at = object.shape->project(0, object.shape->bounds().centre());
      CHECK(glm::dot(0.5 * hi - at.position, at.normal) > 0.0);
    }
  }
}
