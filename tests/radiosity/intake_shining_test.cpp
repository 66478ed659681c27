// SPDX-License-Identifier: MIT
// The intake: rooms in which everything shines, as white furnaces do. No lamp tells there which shell is the room; what lies in what does.

#include <algorithm>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/intake/intake.hpp>

#include "catch.hpp"
#include "radiosity/foreign_rooms.hpp"
#include "radiosity/lattice_furniture.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using rooms::number_in;
using rooms::RandomRooms;
using soup::Soup;

namespace {

constexpr std::uint32_t shining = 2;

// The points in the middle of the sides of a box, a little off, which look out of it, or into it.
void add_seen(std::vector<furniture::SeenPoint>& seen, const glm::dvec3& lo, const glm::dvec3& hi, bool inwards, double lowest) {
  for (glm::length_t k = 0; k < 3; ++k) {
    for (const bool upper : {false, true}) {
      furniture::SeenPoint point{lo + glm::dvec3(0.93, 0.94, 0.95) * (hi - lo), glm::dvec3(0.0)};
      point.position[k] = (upper ? hi : lo)[k];
      point.normal[k] = upper != inwards ? 1.0 : -1.0;
      if (inwards || point.position.z > lowest) { seen.push_back(point); }
    }
  }
}

struct ShiningRoom {
  Soup soup;
  std::vector<furniture::SeenPoint> seen;
};

// A room with one to four things, which stand on the floor or hang, and of which each second one is pierced by a shorter box.
ShiningRoom shining_room(RandomRooms& random, int winding) {
  ShiningRoom made;
  Soup& soup = made.soup;
  soup.materials.push_back({"shining", glm::dvec3(0.5), glm::dvec3(0.5)});
  const auto add = [&](const std::string& name, const glm::dvec3& lo, const glm::dvec3& hi, bool inwards) {
    soup.names.push_back(name);
    const bool turned = winding == 1 || (winding == 2 && !inwards) || (winding == 3 && random() % 2 == 0);
    soup::add_box(soup, lo, hi, 1 + static_cast<int>(random() % 2), inwards != turned, shining);
  };
  const glm::dvec3 size{number_in(random, 3.0, 8.0), number_in(random, 3.0, 8.0), number_in(random, 2.0, 4.0)};
  soup.names.clear();
  add("room", glm::dvec3(0.0), size, true);
  add_seen(made.seen, glm::dvec3(0.0), size, true, 0.0);
  const int things = 1 + static_cast<int>(random() % 4);
  for (int i = 0; i < things; ++i) {
    const glm::dvec3 corner = glm::dvec3(i % 2, i / 2, 0.0) * 0.45 * size + glm::dvec3(0.1, 0.1, 0.0);
    const bool hangs = random() % 3 == 0;
    const glm::dvec3 lo = corner + glm::dvec3(0.0, 0.0, hangs ? 0.3 * size.z : 0.0);
    const glm::dvec3 hi =
        corner + glm::dvec3(number_in(random, 0.3, 0.8), number_in(random, 0.3, 0.8), number_in(random, 0.5, 0.8) * size.z);
    add("thing", lo, hi, false);
    add_seen(made.seen, lo, hi, false, 0.01);
    if (random() % 2 == 0) {
      add("bracket", glm::dvec3(lo.x - 0.05, glm::mix(lo.y, hi.y, 0.2), 0.5 * size.z),
          glm::dvec3(hi.x + 0.06, glm::mix(lo.y, hi.y, 0.7), 0.5 * size.z + 0.1), false);
    }
  }
  return made;
}

}  // namespace

TEST_CASE("intake: a room in which everything shines is a room, and things that others pierce are none, whichever way they were wound") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 40; ++round) {
    const ShiningRoom made = shining_room(random, round % 4);
    const radiosity::Intake intake = made.soup.take_in();
    CAPTURE(round);
    soup::check_sound(made.soup, intake);
    CHECK(intake.rooms.size() == 1);
    const furniture::Sides sides = furniture::sides_of(intake.objects, made.seen, 1e-6);
    CHECK(sides.missing == 0);
    CHECK(sides.backs == 0);
  }
}
