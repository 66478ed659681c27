// SPDX-License-Identifier: MIT
// The intake: walls without thickness that two rooms share, and lamps of two sides before a ceiling.

#include <algorithm>
#include <cmath>
#include <map>
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
using rooms::light_of;
using rooms::number_in;
using rooms::RandomRooms;
using soup::count_of;
using soup::Soup;

namespace {

using Outline = std::vector<glm::dvec3>;

Outline turned(Outline outline) {
  std::reverse(outline.begin(), outline.end());
  return outline;
}

// The same mean light on every group of the first that the second has. Both are solved with links of form factors up to .05.
void check_light(const std::map<std::string, radiosity::Color>& a, const std::map<std::string, radiosity::Color>& b, double tolerance) {
  std::size_t met = 0;
  for (const auto& [group, light] : a) {
    INFO(group);
    if (b.count(group) == 0) { continue; }
    ++met;
    CHECK(light.x > 0.0);
    CHECK(glm::length(b.at(group) - light) <= tolerance * glm::length(light));
  }
  CHECK(met >= 3);
}

// Two rooms side by side, each with a lamp; the wall between them is the side x1 of the first one.
struct TwoRooms {
  glm::dvec3 lo{0.0}, middle{0.0}, hi{0.0};  // middle: the upper corner of the first
  double under = 0.1;                        // the ceilings

  explicit TwoRooms(RandomRooms& random) {
    middle = {number_in(random, 2.0, 5.0), number_in(random, 2.0, 5.0), number_in(random, 2.0, 4.0)};
    hi = {middle.x + number_in(random, 2.0, 5.0), middle.y, middle.z};
  }
  [[nodiscard]] std::vector<Outline> sides(bool second) const {
    Soup box;
    soup::add_box(box, second ? glm::dvec3(middle.x, lo.y, lo.z) : lo, second ? hi : middle, 1, true);
    std::vector<Outline> list;
    for (std::size_t f = 0; f < box.count(); ++f) { list.push_back(box.outline(f)); }
    return list;
  }
  [[nodiscard]] bool shared(const Outline& outline) const {
    return std::all_of(outline.begin(), outline.end(), [&](const glm::dvec3& p) { return p.x == middle.x; });
  }
};

// `twice`: of the shared wall each room has its own; else it is given once, looking either way. `apart`: every wall is a group.
Soup model_of(const TwoRooms& rooms, bool twice, bool first_way, bool apart) {
  Soup out;
  out.names.clear();
  std::vector<Outline> walls;
  for (const bool second : {false, true}) {
    out.names.push_back(second ? "second" : "first");
    for (const Outline& outline : rooms.sides(second)) {
      if (rooms.shared(outline)) {
        walls.push_back(outline);
        continue;
      }
      if (apart) { out.names.push_back(std::string(second ? "second." : "first.") + std::to_string(out.names.size())); }
      out.polygon(outline);
    }
  }
  // The wall is two triangles a room.
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const bool of_second = i >= walls.size() / 2;
    if (!twice && of_second) { continue; }
    if (i == 0 || (twice && i == walls.size() / 2)) { out.names.push_back(!twice ? "divider" : of_second ? "wall of second" : "wall"); }
    out.polygon(twice || first_way ? walls[i] : turned(walls[i]));
  }
  out.names.push_back("lamp");
  rooms::add_ceiling_lamp(out, rooms.lo, rooms.middle, rooms.under);
  out.names.push_back("lamps");
  rooms::add_ceiling_lamp(out, {rooms.middle.x, rooms.lo.y, rooms.lo.z}, rooms.hi, rooms.under);
  return out;
}

}  // namespace

TEST_CASE("intake: a wall that two rooms share lights both, as one wall of each would", "[accuracy]") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 6; ++round) {
    const TwoRooms two(random);
    const bool apart = round % 3 != 0;
    const Soup each = model_of(two, true, true, apart), shared = model_of(two, false, round % 2 == 0, apart);
    const radiosity::Intake taken = shared.take_in(), wanted = each.take_in();
    INFO("round " << round);
    soup::check_sound(shared, taken);
    CHECK(count_of(taken, ChangeKind::dividing) > 0);
    CHECK(count_of(wanted, ChangeKind::dividing) == 0);
    check_light(light_of(each, wanted), light_of(shared, taken), 0.01);
  }
}

TEST_CASE("intake: of a lamp that shines on both sides close under a ceiling the lower side counts", "[accuracy]") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 8; ++round) {
    const Soup room = rooms::furnished_room(random, round % 2 == 1, number_in(random, 0.002, 0.012));  // of a lamp of .6 m or more
    Soup both, high;
    const bool given_twice = round % 4 < 2;  // for its back, too, or by a material of two sides
    if (!given_twice) { both.two_sided = high.two_sided = {0, 1}; }
    for (std::size_t f = 0; f < room.count(); ++f) {
      const bool lamp = room.material[f] == 1;
      Outline outline = lamp && random() % 2 == 0 ? turned(room.outline(f)) : room.outline(f);
      for (Soup* const out : {&both, &high}) {
        for (glm::dvec3& p : outline) { p.z -= lamp && out == &high ? 0.3 : 0.0; }
        out->polygon(outline, room.material[f]);
        out->group.back() = room.group[f];
        if (!lamp || !given_twice) { continue; }
        out->polygon(turned(outline), room.material[f]);
        out->group.back() = room.group[f];
      }
    }
    both.names = high.names = room.names;
    INFO("round " << round);
    const radiosity::Intake taken = both.take_in();
    CHECK(count_of(taken, ChangeKind::lamp_halved) == 1);
    CHECK(count_of(high.take_in(), ChangeKind::lamp_halved) == 0);  // it lights the ceiling, too
    rooms::check_same_light(light_of(room, room.take_in()), light_of(both, taken));
  }
}
