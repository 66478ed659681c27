// SPDX-License-Identifier: MIT
// The intake: flat things that lie on larger ones, as a rug on a floor, cover these, wherever the file and rounding put them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/scene.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "radiosity/foreign_rooms.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using radiosity::ChangeKind;
using rooms::furnished_room;
using rooms::number_in;
using rooms::RandomRooms;
using soup::add_box;
using soup::count_of;
using soup::Soup;

namespace {

struct Decal {
  std::string name;
  std::vector<glm::dvec3> outline;  // seen from its visible side
};

// A rug on the floor, paper on the rug, a cloth on the thing (which is larger), and a picture on the wall x = 0.
std::vector<Decal> decals_in(const Soup& room, RandomRooms& random) {
  glm::dvec3 hi{0.0}, thing_lo{1e300}, thing_hi{-1e300};
  for (std::size_t f = 0; f < room.count(); ++f) {
    for (const glm::dvec3& p : room.outline(f)) {
      const std::string& name = room.names[room.group[f]];
      if (name == "room") { hi = glm::max(hi, p); }
      if (name == "thing") { thing_lo = glm::min(thing_lo, p), thing_hi = glm::max(thing_hi, p); }
    }
  }
  const auto flat = [](const glm::dvec3& a, const glm::dvec3& b) {  // upwards
    return std::vector<glm::dvec3>{a, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}};
  };
  const double u = number_in(random, 0.4, 0.5);
  const glm::dvec3 rug_lo{u * hi.x, u * hi.y, 0}, rug_hi{0.9 * hi.x, 0.9 * hi.y, 0};
  const glm::dvec3 paper_lo = glm::mix(rug_lo, rug_hi, 0.3), paper_hi = glm::mix(rug_lo, rug_hi, 0.6);
  glm::dvec3 cloth_lo = glm::mix(thing_lo, thing_hi, 0.2), cloth_hi = glm::mix(thing_lo, thing_hi, 0.9);
  cloth_lo.z = cloth_hi.z = thing_hi.z;
  const double y = 0.6 * hi.y, z = 0.5 * hi.z, w = 0.2 * hi.y, h = 0.2 * hi.z;
  return {{"rug", flat(rug_lo, rug_hi)},
          {"paper", flat(paper_lo, paper_hi)},
          {"cloth", flat(cloth_lo, cloth_hi)},
          {"picture", {{0, y, z}, {0, y + w, z}, {0, y + w, z + h}, {0, y, z + h}}}};
}

}  // namespace

TEST_CASE("intake: of flat things that lie on larger ones the smaller is seen, in any order of the file") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 24; ++round) {
    const bool sides_unknown = round % 2 == 1;
    const Soup room = furnished_room(random, round % 4 < 2, 0.02);
    const std::vector<Decal> decals = decals_in(room, random);
    const double size = std::exp(number_in(random, -5.0, 5.0)), tolerance = radiosity::IntakeOptions{}.weld * 5.0;
    std::vector<std::size_t> order(room.count() + decals.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    std::vector<std::string> names = room.names;
    for (const Decal& decal : decals) { names.push_back(decal.name); }
    Soup all;
    all.names = names;
    std::shuffle(all.names.begin(), all.names.end(), random);  // objects come in the order of groups
    const auto group_of = [&](const std::string& name) {
      return static_cast<std::uint32_t>(std::find(all.names.begin(), all.names.end(), name) - all.names.begin());
    };
    for (const std::size_t k : order) {
      const bool is_decal = k >= room.count();
      std::vector<glm::dvec3> outline = is_decal ? decals[k - room.count()].outline : room.outline(k);
      const glm::dvec3 off{is_decal ? number_in(random, -2.0, 2.0) * tolerance : 0.0};
      if (is_decal && sides_unknown && random() % 2 == 0) { std::reverse(outline.begin(), outline.end()); }
      for (glm::dvec3& p : outline) { p = size * (p + off); }
      all.polygon(outline, is_decal ? 0 : room.material[k]);
      all.group.back() = group_of(is_decal ? decals[k - room.count()].name : room.names[room.group[k]]);
    }
    const radiosity::IntakeOptions options{.open_sides_unknown = sides_unknown};
    const radiosity::Intake taken = all.take_in(options);
    CAPTURE(round, size, sides_unknown);
    CHECK(count_of(taken, ChangeKind::decal_laid) > 0);
    CHECK(count_of(taken, ChangeKind::open) == 0);
    std::vector<raycast::PlacedObject> placed;
    for (const radiosity::SceneObject& object : taken.objects) { placed.emplace_back(object.shape, object.placement); }
    const raycast::Scene scene(std::move(placed));
    for (std::size_t d = 0; d < decals.size(); ++d) {
      glm::dvec3 at = 0.9 * decals[d].outline[0] + 0.1 * decals[d].outline[2];  // beside the paper on the rug
      const glm::dvec3 normal =
          glm::normalize(glm::cross(decals[d].outline[1] - decals[d].outline[0], decals[d].outline[2] - decals[d].outline[0]));
      const auto hit = scene.closest({size * (at + 0.05 * normal), -size * normal});
      CAPTURE(decals[d].name);
      REQUIRE(hit);
      CHECK(hit->front);
      CHECK(taken.objects[hit->object].name == decals[d].name);  // without a number: it has no back
    }
  }
}

TEST_CASE("intake: the bottom of an open box that stands on a floor is seen, in any order of the file") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 24; ++round) {
    CAPTURE(round);
    Soup walls, box, all;
    const glm::dvec3 size{number_in(random, 3.0, 6.0), number_in(random, 3.0, 6.0), 3.0};
    add_box(walls, glm::dvec3(0.0), size, 1, true);
    const glm::dvec3 lo{number_in(random, 0.2, 1.5), number_in(random, 0.2, 1.5), 0.0};
    const glm::dvec3 hi = lo + glm::dvec3(number_in(random, 0.3, 1.2), number_in(random, 0.3, 1.2), number_in(random, 0.3, 1.2));
    add_box(box, lo, hi, 1, round % 2 == 0);
    all.names = {"first", "second"};
    const std::uint32_t group_of_box = static_cast<std::uint32_t>(random() % 2);
    for (const bool of_box : {false, true}) {
      const Soup& soup = of_box ? box : walls;
      for (std::size_t f = 0; f < soup.count(); ++f) {
        if (of_box && f / 2 == 5) { continue; }  // its lid
        if (!of_box && round % 4 < 2 && f / 2 == 3) { continue; }
        all.polygon(soup.outline(f));
        all.group.back() = of_box ? group_of_box : 1 - group_of_box;
      }
    }
    const radiosity::Intake taken = all.take_in({.open_sides_unknown = true});
    std::vector<raycast::PlacedObject> placed;
    for (const radiosity::SceneObject& object : taken.objects) { placed.emplace_back(object.shape, object.placement); }
    const raycast::Scene scene(std::move(placed));
    for (int k = 0; k < 10; ++k) {
      const glm::dvec3 at = lo + (hi - lo) * glm::dvec3(number_in(random, 0.01, 0.99), number_in(random, 0.01, 0.99), 0.5);
      const auto hit = scene.closest({at, {0, 0, -1}});
      REQUIRE(hit);
      CHECK(hit->front);
      CHECK(taken.objects[hit->object].name.substr(0, 5) == all.names[group_of_box].substr(0, 5));
    }
  }
}

TEST_CASE("intake: a ceiling is no rug of the floor above it, and a sheet of the same size is none at all") {
  for (const bool up : {false, true}) {
    for (const bool lower_first : {false, true}) {
      Soup soup;
      const double side = up ? 3.0 : 2.0;  // looking up: as large as the floor
      const auto floor = [&] { soup.polygon({{0, 0, 1}, {3, 0, 1}, {3, 3, 1}, {0, 3, 1}}); };
      const auto other = [&] {
        std::vector<glm::dvec3> outline{{0.1, 0, 1}, {0.1, side, 1}, {0.1 + side, side, 1}, {0.1 + side, 0, 1}};
        if (up) { std::reverse(outline.begin(), outline.end()); }
        soup.polygon(outline);
      };
      if (lower_first) { other(); }
      floor();
      if (!lower_first) { other(); }
      soup.names = lower_first ? std::vector<std::string>{"ceiling", "floor"} : std::vector<std::string>{"floor", "ceiling"};
      soup.group = {0, 1};
      const radiosity::IntakeOptions options{.open_sides_unknown = true};
      const radiosity::Intake taken = soup.take_in(options);
      CHECK(taken.faces == 4);
      CHECK(taken.objects.front().name == (lower_first ? "ceiling.1" : "floor.1"));
    }
  }
}
