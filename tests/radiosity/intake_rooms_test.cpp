// SPDX-License-Identifier: MIT
// The intake: rooms as strangers write them. Walls, floor and ceiling in groups of their own, polygons given again for their back, lamps
// flush in a ceiling, walls with a thickness without a lamp: each must become what the sound model becomes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"

namespace {

using radiosity::ChangeKind;
using soup::count_of;
using soup::Soup;

using RandomRooms = std::mt19937;

double number_in(RandomRooms& random, double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }

// Copies the polygons from `first` on, each in the group that pick(its number) names, turned where turn() says so.
template <class Pick, class Turn>
void copy_polygons(const Soup& from, Soup& to, const Pick& pick, const Turn& turn) {
  for (std::size_t f = 0; f < from.count(); ++f) {
    std::vector<glm::dvec3> outline = from.outline(f);
    if (turn()) { std::reverse(outline.begin(), outline.end()); }
    to.polygon(outline, from.material[f]);
    to.group.back() = pick(f);
  }
}

// The six sides of a box, each in a group of its own and each cut as finely as it likes, so that their borders meet in T-joints.
void add_sides(Soup& out, RandomRooms& random, const glm::dvec3& lo, const glm::dvec3& hi, bool inwards, bool mixed) {
  for (std::uint32_t side = 0; side < 6; ++side) {
    const int n = 1 + static_cast<int>(random() % 3);
    Soup box, one;
    soup::add_box(box, lo, hi, n, inwards);
    const std::size_t each = box.count() / 6;
    out.names.push_back("side" + std::to_string(out.names.size()));
    const bool turned = mixed && random() % 2 == 0;
    for (std::size_t f = side * each; f < (side + 1) * each; ++f) {
      std::vector<glm::dvec3> outline = box.outline(f);
      if (turned) { std::reverse(outline.begin(), outline.end()); }
      out.polygon(outline);
    }
  }
}

void add_ceiling_lamp(Soup& out, const glm::dvec3& lo, const glm::dvec3& hi, double under) {
  const glm::dvec3 a = lo + 0.3 * (hi - lo), b = lo + 0.6 * (hi - lo);
  const double z = hi.z - under;
  out.polygon({{a.x, a.y, z}, {a.x, b.y, z}, {b.x, b.y, z}, {b.x, a.y, z}}, 1);  // looks down
}

// Mean radiosity of each group of the soup, by its name without a number.
std::map<std::string, radiosity::Color> light_of(const Soup& soup, const radiosity::Intake& intake) {
  radiosity::Options options;
  options.epsilon = 0.05;
  options.audit_points = 0;
  const radiosity::Outcome outcome = radiosity::solve({soup.materials, intake.objects}, options);
  std::map<std::string, radiosity::Color> sum;
  std::map<std::string, double> area;
  REQUIRE(outcome.solution);
  for (const radiosity::SurfaceMean& surface : outcome.solution->audit.surfaces) {
    const std::string group = surface.name.substr(0, surface.name.find('.'));
    sum[group] += surface.area * surface.radiosity;
    area[group] += surface.area;
  }
  for (auto& [group, light] : sum) { light /= area[group]; }
  return sum;
}

void check_same_light(const std::map<std::string, radiosity::Color>& a, const std::map<std::string, radiosity::Color>& b) {
  REQUIRE(a.size() == b.size());
  for (const auto& [group, light] : a) {
    INFO(group);
    REQUIRE(b.count(group) == 1);
    CHECK(glm::length(b.at(group) - light) <= 0.005 * glm::length(light));
    CHECK(light.x > 0.0);
  }
}

// A room, a thing in it and a lamp under its ceiling, each a group; within walls of a thickness, or not.
Soup furnished_room(RandomRooms& random, bool walls, double under) {
  Soup room;
  const glm::dvec3 hi{number_in(random, 2.0, 6.0), number_in(random, 2.0, 6.0), number_in(random, 2.0, 4.0)};
  room.names = {"room"};
  soup::add_box(room, glm::dvec3(0.0), hi, 1, true);
  if (walls) {
    room.names.push_back("walls");
    soup::add_box(room, glm::dvec3(-0.2), hi + 0.2);
  }
  room.names.push_back("thing");
  soup::add_box(room, 0.1 * hi, glm::dvec3(0.25, 0.3, number_in(random, 0.2, 0.7)) * hi, 1);
  room.names.push_back("lamp");
  add_ceiling_lamp(room, glm::dvec3(0.0), hi, under);
  return room;
}

}  // namespace

TEST_CASE("intake: groups that close a shell together look where one group looks") {
  const unsigned seed = std::random_device{}();
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

TEST_CASE("intake: polygons given again for their back change no light") {
  const unsigned seed = std::random_device{}();
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

// Which way up such a lamp was given, where rounding has put it, and whether it comes before or after its room in the file: all the same.
TEST_CASE("intake: a lamp that lies flush in a ceiling shines into the room") {
  const unsigned seed = std::random_device{}();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 8; ++round) {
    const Soup room = furnished_room(random, round % 2 == 1, 0.0);
    const auto wanted = light_of(room, room.take_in());
    const double tolerance = radiosity::IntakeOptions{}.weld * 5.0, size = std::exp(number_in(random, -5.0, 5.0));
    const bool face_up = round % 4 < 2, two_sided = round % 3 == 2;
    // Within the tolerance, or, where it would light the ceiling from below or from behind, within a thousandth of its size, .6 m or more.
    const double far = face_up ? number_in(random, -4e-4, 4e-4) : number_in(random, 0.0, 4e-4);
    const double beside = round % 3 == 1 ? far : number_in(random, -2.0, 2.0) * tolerance;
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

// No lamp and no eye tells which side is seen; what is in what does.
TEST_CASE("intake: walls of a thickness hold rooms, and a room inside out holds things") {
  const unsigned seed = std::random_device{}();
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

TEST_CASE("a run whose light reaches nothing says so") {
  RandomRooms random(3);
  for (const double under : {0.1, -0.1}) {  // the lamp lies above the ceiling
    const Soup room = furnished_room(random, false, under);
    radiosity::Options options;
    options.epsilon = 0.05;
    options.audit_points = 0;
    radiosity::IntakeOptions inside;
    inside.eyes = {{1, 1, 1}};
    const radiosity::Outcome outcome = radiosity::solve({room.materials, room.take_in(inside).objects}, options);
    REQUIRE(outcome.solution);
    const std::vector<std::string>& warnings = outcome.solution->audit.warnings;
    const bool said =
        std::any_of(warnings.begin(), warnings.end(), [](const auto& s) { return s.find("reflected by any surface") != s.npos; });
    CHECK(said == (under < 0.0));
  }
}
