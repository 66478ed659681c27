// SPDX-License-Identifier: MIT
// Models without a lamp and without a camera: a furnished room that nobody sees from outside gets a lamp, and is looked at from inside;
// what has more to show outside is put into a studio.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/camera/view.hpp>

#include "apps/intake/light_views.hpp"
#include "apps/intake/to_scene.hpp"
#include "catch.hpp"
#include "houses.hpp"
#include "models.hpp"
#include "seed.hpp"

namespace {

// A room with a doorway; `inside`, `outside`: numbers of things on its floor, and beside the house.
apps::Model house(std::mt19937& random, const glm::dvec3& room, double scale, int inside, int outside, bool ceiling = true) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  apps::Model model;
  model.groups = {"house"};
  model.materials = {{"grey", radiosity::Color(0.5)}};
  const auto box = [&](const glm::dvec3& lo, const glm::dvec3& hi) { houses::add_box(model, scale * lo, scale * hi, false); };
  houses::add_walls_with_doorway(model, room, 0.9, scale, ceiling);
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

// Two slopes on the walls, with a small overhang, and the triangles of the walls between them, all given from outside alone. The result:
// the first polygon of them; the slopes come first.
std::size_t add_gable_roof(apps::Model& model, const glm::dvec3& room, double scale, double rise) {
  const std::size_t before = model.polygons();
  const auto add = [&](const std::vector<glm::dvec3>& outline) {
    std::vector<std::uint32_t> corners;
    for (const glm::dvec3& p : outline) {
      corners.push_back(static_cast<std::uint32_t>(model.positions.size()));
      model.positions.push_back(scale * p);
    }
    model.polygon(corners, 0, 0);
  };
  const double over = 0.3, middle = 0.5 * room.x, eaves = room.z - rise * over / middle, ridge = room.z + rise;
  const double from = -over, to = room.y + over;
  add({{-over, from, eaves}, {middle, from, ridge}, {middle, to, ridge}, {-over, to, eaves}});
  add({{middle, from, ridge}, {room.x + over, from, eaves}, {room.x + over, to, eaves}, {middle, to, ridge}});
  add({{0, 0, room.z}, {room.x, 0, room.z}, {middle, 0, ridge}});
  add({{room.x, room.y, room.z}, {0, room.y, room.z}, {middle, room.y, ridge}});
  return before;
}

}  // namespace

// A viewer sees through the back of such a roof. Without a ceiling of the thickness of a wall, light would come in, and from a camera below
// the roof would be black.
TEST_CASE("a roof given from above alone shows its underside to those who stand in the room below, and only then") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  enum class Eye { none, within, above };
  for (int round = 0; round < 12; ++round) {
    const double scale = std::exp(6.0 * unit(random) - 3.0);
    const glm::dvec3 room = glm::dvec3(4.0 + 3.0 * unit(random), 4.0 + 3.0 * unit(random), 2.3 + unit(random));
    const Eye eye = std::array{Eye::none, Eye::within, Eye::above}[static_cast<std::size_t>(round) % 3];
    apps::Model model = house(random, room, scale, 36, 0, false);
    const std::size_t roof = add_gable_roof(model, room, scale, 0.2 * unit(random) * room.z);
    if (eye != Eye::none) {
      const double height = eye == Eye::within ? 0.6 : 2.0;
      const glm::dvec3 at = room * glm::dvec3(0.3 + 0.4 * unit(random), 0.3 + 0.4 * unit(random), height);
      model.cameras.push_back({.name = "own", .eye = scale * at, .forward = glm::dvec3(0.1, 0.2, eye == Eye::above ? -1.0 : 0.0)});
    }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CAPTURE(round, scale, room.x, room.y, room.z);
    const bool both = eye != Eye::above;
    CHECK(models::noted(file->notes, "to a room: ") == both);
    CHECK(models::noted(file->notes, "hangs under its ceiling") == both);
    REQUIRE(file->given);
    for (std::size_t polygon = roof; polygon < roof + 2; ++polygon) {
      const auto parts = file->given->parts.of(polygon);
      CHECK(std::ranges::count_if(parts, [](const auto& part) { return !part.back; }) == 1);
      CHECK(std::ranges::count_if(parts, [](const auto& part) { return part.back; }) == (both ? 1 : 0));
    }
    if (eye != Eye::none) { continue; }
    REQUIRE_FALSE(file->cameras.empty());
    const glm::dvec3 stands = file->cameras.front().eye / scale;
    CHECK((stands.x > 0.0 && stands.x < room.x && stands.y > 0.0 && stands.y < room.y && stands.z < 1.2 * room.z));
    CHECK(apps::LightViews(file->scene).lit_share(file->cameras.front()) > 0.3);
  }
}

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

// Bellied vessels with thick walls and a narrow mouth. From within, each direction meets a face of its own; so does each ray from outside,
// if there are as many.
TEST_CASE("a vessel of many small faces is no furnished room") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 8; ++round) {
    const double scale = std::exp(8.0 * unit(random) - 4.0), height = 2.0 + 2.0 * unit(random), thick = 0.05 + 0.05 * unit(random);
    constexpr std::uint32_t around = 40, along = 60;
    std::vector<glm::dvec2> profile{{0.0, 0.0}};  // radius and height: up outside, down inside
    const auto belly = [&](double t) { return 0.2 + std::sin(std::numbers::pi * (0.1 + 0.9 * t)); };
    for (std::uint32_t i = 0; i <= along; ++i) { profile.push_back({belly(1.0 * i / along), height * i / along}); }
    for (std::uint32_t i = along + 1; i-- > 1;) { profile.push_back({belly(1.0 * i / along) - thick, height * i / along}); }
    profile.push_back({0.0, height / along});
    apps::Model model;
    model.groups = {"vessel"};
    model.materials = {{"clay", radiosity::Color(0.5)}};
    for (const glm::dvec2& p : profile) {
      for (std::uint32_t k = 0; k < around; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / around;
        model.positions.push_back(scale * glm::dvec3(p.x * std::cos(angle), p.x * std::sin(angle), p.y));
      }
    }
    for (std::uint32_t i = 0; i + 1 < profile.size(); ++i) {
      for (std::uint32_t k = 0; k < around; ++k) {
        const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around;
        model.polygon(std::array{a, b, b + around, a + around}, 0, 0);
      }
    }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CHECK(models::noted(file->notes, "put into a studio"));
  }
}

// As programs write heads and bottles: a skin of many small faces that may be seen from either side, open below, here on a wide
// square of ground.
TEST_CASE("a hollow body whose faces may be seen from either side is no furnished room") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 8; ++round) {
    const double scale = std::exp(8.0 * unit(random) - 4.0), bumps = 0.1 * unit(random), phase = 6.0 * unit(random);
    constexpr std::uint32_t around = 50, along = 30;
    apps::Model model;
    model.groups = {"head"};
    model.materials = {{"skin", radiosity::Color(0.5)}};
    model.materials[0].two_sided = true;
    for (std::uint32_t i = 0; i <= along; ++i) {
      for (std::uint32_t k = 0; k < around; ++k) {
        const double down = std::numbers::pi * i / along, angle = 2.0 * std::numbers::pi * k / around;
        const double radius = scale * (1.0 + bumps * std::sin(5.0 * down + phase) * std::sin(3.0 * angle));
        model.positions.push_back(radius * glm::dvec3(std::sin(down) * std::cos(angle), std::sin(down) * std::sin(angle), std::cos(down)));
      }
    }
    for (std::uint32_t i = 0; i + 5 < along; ++i) {
      for (std::uint32_t k = 0; k < around; ++k) {
        const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around;
        model.polygon(std::array{a, a + around, b + around, b}, 0, 0);
      }
    }
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    for (const auto& [x, y] : {std::pair{-16, -16}, {16, -16}, {16, 16}, {-16, 16}}) {
      model.positions.push_back(scale * glm::dvec3(x, y, -0.8));
    }
    model.polygon(std::array{first, first + 1, first + 2, first + 3}, 0, 0);
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CAPTURE(round, scale, bumps);
    CHECK(models::noted(file->notes, "put into a studio"));
  }
}

// Of the walls the viewer sees the insides, through the backs of those before them; the light of a studio would not pass.
TEST_CASE("a room whose walls are given from inside alone is lit inside, though it has a doorway") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 8; ++round) {
    const double scale = std::exp(6.0 * unit(random) - 3.0);
    const glm::dvec3 room = scale * glm::dvec3(4.0 + 3.0 * unit(random), 4.0 + 3.0 * unit(random), 2.3 + unit(random));
    CAPTURE(round, scale, room.x, room.y, room.z);
    apps::Model closed, model;
    houses::add_box(closed, {0, 0, 0}, room, true);
    model.groups = {"room"};
    model.materials = {{"grey", radiosity::Color(0.5)}};
    model.positions = closed.positions;
    for (std::uint32_t p = 0; p < closed.polygons(); ++p) {
      const std::span<const std::uint32_t> corners = std::span(closed.corners).subspan(closed.first_corner[p], 4);
      const bool wall = std::ranges::all_of(corners, [&](std::uint32_t c) { return closed.positions[c].y == 0.0; });
      if (!wall) { model.polygon(corners, 0, 0); }
    }
    const double door = (0.5 + 0.3 * unit(random)) * room.x, width = 0.15 * room.x;
    for (const auto& [from, to] : {std::pair{0.0, door}, std::pair{door + width, room.x}}) {
      const auto first = static_cast<std::uint32_t>(model.positions.size());
      for (const glm::dvec3& p : {glm::dvec3(from, 0, 0), {from, 0, room.z}, {to, 0, room.z}, {to, 0, 0}}) { model.positions.push_back(p); }
      model.polygon(std::array{first, first + 1, first + 2, first + 3}, 0, 0);
    }
    houses::add_box(model, 0.3 * room * glm::dvec3(1, 1, 0), room * glm::dvec3(0.5, 0.5, 0.4), false);
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CHECK(models::noted(file->notes, "under its ceiling"));
    const radiosity::Camera camera = file->cameras.empty() ? radiosity::automatic_camera(file->scene) : file->cameras.front();
    CHECK(apps::LightViews(file->scene).lit_share(camera) > 0.5);
  }
}
