// SPDX-License-Identifier: MIT
// Models without a lamp and without a camera: a furnished room that nobody sees from outside gets a lamp, and is looked at from inside;
// what has more to show outside is put into a studio.

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/camera/view.hpp>

#include "apps/intake/light_views.hpp"
#include "apps/intake/to_scene.hpp"
#include "catch.hpp"
#include "houses.hpp"
#include "seed.hpp"

namespace {

// A room with a doorway; `inside`, `outside`: numbers of things on its floor, and beside the house.
apps::Model house(std::mt19937& random, const glm::dvec3& room, double scale, int inside, int outside) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  apps::Model model;
  model.groups = {"house"};
  model.materials = {{"grey", radiosity::Color(0.5)}};
  const auto box = [&](const glm::dvec3& lo, const glm::dvec3& hi) { houses::add_box(model, scale * lo, scale * hi, false); };
  houses::add_walls_with_doorway(model, room, 0.9, scale);
  const auto things = [&](int count, const glm::dvec3& lo, const glm::dvec3& hi) {
    const int across = 6;
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 cell{(hi.x - lo.x) / across, (hi.y - lo.y) / across, 0.0};
      const glm::dvec3 at = lo + glm::dvec3(i % across, i / across, 0) * cell;
      box(at + 0.2 * cell, at + 0.8 * cell + glm::dvec3(0, 0, (0.1 + 0.3 * unit(random)) * room.z));
    }
  };
  things(inside, {0, 0, 0}, room);
  things(outside, {room.x + 1, -room.y, 0}, {2 * room.x + 1, room.y, 0});
  return model;
}

}  // namespace

TEST_CASE("a furnished room without a lamp or a camera is lit, and seen from inside") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 8; ++round) {
    const double scale = std::exp(6.0 * unit(random) - 3.0);
    const glm::dvec3 room = glm::dvec3(4.0 + 3.0 * unit(random), 4.0 + 3.0 * unit(random), 2.3 + unit(random));
    const bool furnished = round % 2 == 0;
    std::vector<std::string> faults;
    const auto file = apps::to_scene(house(random, room, scale, furnished ? 36 : 0, furnished ? 0 : 36), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CAPTURE(round, scale, room.x, room.y, room.z);
    const auto noted = [&](const std::string& words) {
      return std::any_of(file->notes.begin(), file->notes.end(), [&](const auto& note) { return note.find(words) != std::string::npos; });
    };
    CHECK(noted(furnished ? "hangs under its ceiling" : "put into a studio"));
    REQUIRE_FALSE(file->cameras.empty());
    const glm::dvec3 eye = file->cameras.front().eye / scale;
    CHECK((eye.x > 0.0 && eye.x < room.x && eye.y > 0.0 && eye.y < room.y && eye.z > 0.0 && eye.z < room.z) == furnished);
    CHECK(apps::LightViews(file->scene).lit_share(file->cameras.front()) > 0.3);
  }
}
