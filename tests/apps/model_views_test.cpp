// SPDX-License-Identifier: MIT
// Models of rooms and houses: from where they are looked at, and where they get a lamp that they have not.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/scene.hpp>

#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/intake/light_views.hpp"
#include "houses.hpp"
#include "models.hpp"
#include "seed.hpp"

using houses::add_box;
using houses::house_without_lamp;
using models::noted;
using models::scene;

TEST_CASE("a house whose lamps are in its rooms is looked at from within, a room as a doll's house") {
  const std::string room =
      "v 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nv 0 3 0\nv 4 3 0\nv 4 3 4\nv 0 3 4\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 "
      "1 5 8\n";
  const std::string lamp = "usemtl lamp\nv 1 2.9 1\nv 1 2.9 2\nv 2 2.9 2\nv 2 2.9 1\nf -4 -3 -2 -1\n";
  const std::string walls =
      "v -1 -1 -1\nv 5 -1 -1\nv 5 -1 5\nv -1 -1 5\nv -1 4 -1\nv 5 4 -1\nv 5 4 5\nv -1 4 5\n"
      "f -8 -7 -6 -5\nf -4 -1 -2 -3\nf -8 -4 -3 -7\nf -7 -3 -2 -6\nf -6 -2 -1 -5\nf -5 -1 -4 -8\n";
  apps::ModelOptions options;
  options.lamps = {{"lamp", 10.0}};
  const apps::SceneFile doll = scene("a.obj", room + lamp, {}, options), house = scene("a.obj", room + walls + lamp, {}, options);
  CHECK(doll.cameras.empty());
  REQUIRE(house.cameras.size() == 1);
  CHECK(noted(house.notes, "the camera stands in the room of a lamp"));
  const glm::dvec3 eye = house.cameras[0].eye;  // y was up
  CHECK((eye.x > 0.0 && eye.x < 4.0 && eye.y < 0.0 && eye.y > -4.0 && eye.z > 0.0 && eye.z < 3.0));
  // Walls that shine less than a hundredth as bright as a lamp are no lamps to look at, from outside.
  options.lamps.push_back({"paint", 0.05});
  const apps::SceneFile painted = scene("a.obj", "usemtl paint\n" + room + walls + lamp, {}, options);
  REQUIRE(painted.cameras.size() == 1);
  CHECK(painted.cameras[0].eye == eye);
}

// The windows are in the wall that the automatic view looks at.
TEST_CASE("a house that shows its light from outside through windows alone is looked at from within") {
  for (const int windows : {0, 1, 2}) {
    apps::Model model;
    model.groups = {"house", "lamp"};
    model.materials = {{"grey", radiosity::Color(0.5)}, {"lamp", radiosity::Color(0.0), radiosity::Color(100.0)}};
    add_box(model, {-0.2, -0.2, -0.2}, {6.2, 4.2, 0}, false);
    add_box(model, {-0.2, -0.2, 2.5}, {6.2, 4.2, 2.7}, false);
    add_box(model, {-0.2, -0.2, 0}, {0, 4.2, 2.5}, false);
    add_box(model, {6, -0.2, 0}, {6.2, 4.2, 2.5}, false);
    add_box(model, {0, 4, 0}, {6, 4.2, 2.5}, false);
    double from = 0.0;
    for (int k = 0; k < windows; ++k) {
      const double to = 1.5 + 3.0 * k;
      add_box(model, {from, -0.2, 0}, {to, 0, 2.5}, false);
      add_box(model, {to, -0.2, 0}, {to + 0.8, 0, 1}, false);
      add_box(model, {to, -0.2, 1.9}, {to + 0.8, 0, 2.5}, false);
      from = to + 0.8;
    }
    add_box(model, {from, -0.2, 0}, {6, 0, 2.5}, false);
    add_box(model, {2.8, 1.8, 2.4}, {3.2, 2.2, 2.45}, false, 1);
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    CAPTURE(windows);
    REQUIRE(file);
    REQUIRE(file->cameras.size() == 1);
    const glm::dvec3 eye = file->cameras[0].eye;
    CHECK((eye.x > 0.0 && eye.x < 6.0 && eye.y > 0.0 && eye.y < 4.0 && eye.z > 0.0 && eye.z < 2.5));
    CHECK(apps::LightViews(file->scene).lit_share(file->cameras[0]) > 0.5);
  }
}

// A ring of light under the ceiling of a hall, around a core of stone in which there is a closet with a small lamp: below the middle of the
// ring one stands in the closet.
TEST_CASE("a hall around a lit closet is looked at, not the closet") {
  apps::Model model;
  model.groups = {"house", "ring", "lamp"};
  model.materials = {{"grey", radiosity::Color(0.5)}, {"lamp", radiosity::Color(0.0), radiosity::Color(100.0)}};
  const raycast::Box closet{{5.8, 3.8, 2.5}, {6.2, 4.2, 2.95}};
  add_box(model, {0, 0, 0}, {12, 8, 3}, true);
  add_box(model, {-0.2, -0.2, -0.2}, {12.2, 8.2, 3.2}, false);
  add_box(model, {4, 2, 0.01}, {8, 6, 2.99}, false);
  add_box(model, closet.lo, closet.hi, true);
  add_box(model, {5.98, 3.98, 2.93}, {6.02, 4.02, 2.94}, false, 1);
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  const double outer[4][2] = {{1, 1}, {11, 1}, {11, 7}, {1, 7}}, inner[4][2] = {{1.5, 1.5}, {10.5, 1.5}, {10.5, 6.5}, {1.5, 6.5}};
  for (const auto& p : outer) { model.positions.push_back({p[0], p[1], 2.9}); }
  for (const auto& p : inner) { model.positions.push_back({p[0], p[1], 2.9}); }
  for (std::uint32_t i = 0; i < 4; ++i) {  // faces down
    const std::uint32_t next = (i + 1) % 4;
    const std::uint32_t corners[] = {first + i, first + 4 + i, first + 4 + next, first + next};
    model.polygon(corners, 1, 1);
  }
  std::vector<std::string> faults;
  const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
  REQUIRE(file);
  REQUIRE(file->cameras.size() == 1);
  CAPTURE(file->cameras[0].eye.x, file->cameras[0].eye.y, file->cameras[0].eye.z);
  CHECK_FALSE(closet.contains(file->cameras[0].eye));
  CHECK(raycast::Box{{0, 0, 0}, {12, 8, 3}}.contains(file->cameras[0].eye));
}

// Walls seen from both sides, as many formats have them: the outside is black, and through the open end much of what is seen is lit.
TEST_CASE("a corridor with an open end is looked at from within, a niche through its opening") {
  for (const double length : {3.0, 6.0}) {
    CAPTURE(length);
    apps::Model model;
    model.groups = {"corridor", "lamp"};
    model.materials = {{"grey", radiosity::Color(0.5), radiosity::Color(0.0), true},
                       {"lamp", radiosity::Color(0.0), radiosity::Color(10.0)}};
    add_box(model, {0, 0, 0}, {3, length, 3}, true);
    const auto at_end = [&](std::uint32_t corner) { return model.positions[corner].y == 0.0; };
    apps::Model open;
    open.positions = model.positions;
    open.groups = model.groups;
    open.materials = model.materials;
    for (std::size_t p = 0; p < model.polygons(); ++p) {
      const std::span<const std::uint32_t> corners = std::span(model.corners).subspan(model.first_corner[p], 4);
      if (!std::ranges::all_of(corners, at_end)) { open.polygon(corners, 0, 0); }
    }
    add_box(open, {1, 0.3 * length, 2.8}, {2, 0.6 * length, 2.9}, false, 1);
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(open), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    REQUIRE(file->cameras.size() <= 1);
    const bool within = !file->cameras.empty() && raycast::Box{{0, 0, 0}, {3, length, 3}}.contains(file->cameras[0].eye);
    CHECK(within == (length > 5.0));
  }
}

// A block of stone with a chamber on it that a lamp nearly fills, behind windows and under a roof.
TEST_CASE("a stone lantern is looked at from outside, not from within its chamber") {
  apps::Model model;
  model.groups = {"stone", "lamp"};
  model.materials = {{"stone", radiosity::Color(0.5)}, {"lamp", radiosity::Color(0.5), radiosity::Color(100.0)}};
  add_box(model, {0, 0, 0}, {1, 1, 2.4}, false);
  add_box(model, {-0.2, -0.2, 3}, {1.2, 1.2, 3.3}, false);
  for (const double x : {0.0, 0.7}) {
    for (const double y : {0.0, 0.7}) { add_box(model, {x, y, 2.4}, {x + 0.3, y + 0.3, 3}, false); }
  }
  add_box(model, {0.31, 0.31, 2.45}, {0.69, 0.69, 2.95}, false, 1);
  std::vector<std::string> faults;
  const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
  REQUIRE(file);
  const glm::dvec3 middle{0.5, 0.5, 2.7};
  CHECK((file->cameras.empty() || glm::length(file->cameras[0].eye - middle) > 2.0));
}

// Above the panel and between the plates everything is bright; from outside only the small part of the picture that the luminaire fills.
TEST_CASE("a luminaire with plates above its panel is looked at from outside, not from between them") {
  apps::Model model;
  model.groups = {"tray", "lamp"};
  model.materials = {{"tray", radiosity::Color(0.7)}, {"lamp", radiosity::Color(0.5), radiosity::Color(100.0)}};
  add_box(model, {0, 0, 0}, {12, 1, 0.05}, false);
  add_box(model, {-0.05, -0.05, 0}, {12.05, 0, 0.35}, false);
  add_box(model, {-0.05, 1, 0}, {12.05, 1.05, 0.35}, false);
  for (int i = 0; i <= 24; ++i) { add_box(model, {0.5 * i - 0.01, 0, 0.25}, {0.5 * i + 0.01, 1, 0.35}, false); }
  add_box(model, {0.1, 0.1, 0.1}, {11.9, 0.9, 0.15}, false, 1);
  std::vector<std::string> faults;
  const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
  REQUIRE(file);
  CHECK((file->cameras.empty() || !raycast::Box{{-0.05, -0.05, 0}, {12.05, 1.05, 0.35}}.contains(file->cameras[0].eye)));
}

// Flat boxes close under the ceiling, as ceiling lamps are, over furniture.
TEST_CASE("the camera in a house stands at the height of an eye and sees what lamps shine on") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const double size = std::exp(8.0 * unit(random) - 4.0);
    const glm::dvec3 extent = size * glm::dvec3(3.0 + 3.0 * unit(random), 3.0 + 2.0 * unit(random), 2.3 + unit(random));
    apps::Model model;
    model.groups = {"house", "lamp", "thing"};
    model.materials = {{"grey", radiosity::Color(0.5)}, {"lamp", radiosity::Color(0.1), radiosity::Color(100.0)}};
    add_box(model, {0, 0, 0}, extent, true);
    add_box(model, glm::dvec3(-0.2 * size), extent + 0.2 * size, false);
    const double gap = size * std::exp(-6.0 + 5.0 * unit(random)), thick = size * (0.01 + 0.1 * unit(random));
    const glm::dvec3 lamp = extent * glm::dvec3(0.2 + 0.5 * unit(random), 0.2 + 0.5 * unit(random), 1.0) - glm::dvec3(0, 0, gap + thick);
    add_box(model, lamp, lamp + glm::dvec3(0.4 * size, 0.4 * size, thick), false, 1);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 lo = extent * glm::dvec3(0.05 + 0.7 * unit(random), 0.05 + 0.7 * unit(random), 0.0) + glm::dvec3(0, 0, 0.01 * size);
      add_box(model, lo, lo + size * glm::dvec3(0.3 + 0.4 * unit(random), 0.3 + 0.4 * unit(random), 0.3 + 0.6 * unit(random)), false, 2);
    }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    REQUIRE(file->cameras.size() == 1);
    std::vector<raycast::PlacedObject> placed;
    for (const auto& object : file->scene.objects) { placed.emplace_back(object.shape, object.placement); }
    const raycast::Scene objects(std::move(placed));
    const radiosity::Camera& camera = file->cameras[0];
    const auto below = objects.closest({camera.eye, {0, 0, -1}}), above = objects.closest({camera.eye, {0, 0, 1}});
    CAPTURE(round, size, gap / size, camera.eye.z / extent.z);
    REQUIRE((below && above));
    CHECK(below->t > 0.2 * (below->t + above->t));
    CHECK(above->t > 0.2 * (below->t + above->t));
    CHECK(apps::LightViews(file->scene).lit_share(camera) > 0.2);
  }
}

// A round lamp of many polygons in a house: in whatever order a program wrote them, the picture is the same.
TEST_CASE("the camera in a house does not depend on the order of polygons, and one that sees no light is told") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::vector<std::vector<glm::dvec3>> polygons;
  constexpr int n = 8;
  const auto at = [](int i, int k) {
    const double a = std::numbers::pi * i / n, b = 2.0 * std::numbers::pi * k / n;
    return glm::dvec3(1.5, 2, 2.3) + 0.12 * glm::dvec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
  };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      polygons.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
      if (i == 0) { polygons.back().pop_back(); }
      if (i == n - 1) { polygons.back().erase(polygons.back().begin() + 2); }
    }
  }
  std::optional<radiosity::Camera> first;
  for (int round = 0; round < 6; ++round) {
    apps::Model model = house_without_lamp(true);
    model.groups.emplace_back("lamp");
    model.materials.push_back({"lamp", radiosity::Color(0.1), radiosity::Color(100.0)});
    for (const std::vector<glm::dvec3>& outline : polygons) {
      std::vector<std::uint32_t> corners;
      for (const glm::dvec3& p : outline) {
        corners.push_back(static_cast<std::uint32_t>(model.positions.size()));
        model.positions.push_back(p);
      }
      model.polygon(corners, 1, 1);
    }
    std::shuffle(polygons.begin(), polygons.end(), random);
    if (round == 5) {
      radiosity::Camera outside;
      outside.name = "outside";
      outside.eye = {-8, -6, 4};
      outside.forward = glm::dvec3(2, 2, 1.5) - outside.eye;
      model.cameras = {outside};
    }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    REQUIRE(file->cameras.size() == (round == 5 ? 2 : 1));
    CHECK(noted(file->notes, round == 5 ? "camera 'outside' sees next to nothing that a lamp shines on" : "from outside little is seen"));
    const radiosity::Camera& inside = file->cameras.front();  // which draws the picture
    CHECK(inside.name == "inside");
    if (!first) { first = inside; }
    CHECK(glm::length(inside.eye - first->eye) < 1e-6);
    CHECK(glm::length(inside.forward - first->forward) < 1e-6);
  }
}

// A block in the sun, and cameras of the file that look at its shadowed side or away from it.
TEST_CASE("a file whose first camera sees nothing lit is looked at by another, or from outside, where that shows its light") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 6; ++round) {
    apps::Model model;
    model.groups = {"block"};
    model.materials = {{"grey", radiosity::Color(0.5)}};
    houses::add_box(model, {0, 0, 0}, {1.0 + unit(random), 1.0 + unit(random), 1.0 + unit(random)}, false);
    apps::ModelLight sun;
    sun.kind = apps::ModelLight::Kind::sun;
    sun.intensity = radiosity::Color(1.0);
    sun.direction = {0.1, 0.8, -1.0};
    model.lights = {sun};
    radiosity::Camera behind;
    behind.name = "behind";
    behind.eye = {1.0, 8.0 + unit(random), 0.4};
    behind.forward = round % 2 == 0 ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 1, 0);
    radiosity::Camera before;
    before.name = "before";
    before.eye = {1.0, -8.0, 3.0 + unit(random)};
    before.forward = {0, 8, -3};
    model.cameras = {behind, behind};
    const bool one_sees = round >= 4;
    if (one_sees) { model.cameras.push_back(before); }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CAPTURE(round);
    CHECK(noted(file->notes, std::string("the picture is taken by another, '") + (one_sees ? "before" : "automatic") + "'"));
    REQUIRE(file->cameras.size() == 3);
    CHECK(file->cameras[1].name == "behind");
    CHECK(file->cameras[2].name == "behind");
    CHECK(apps::LightViews(file->scene).lit_share(file->cameras.front()) > 0.3);
  }
}

TEST_CASE("a box with a screen sunk into its front is no room, though the file tells no sides") {
  apps::Model model;
  model.groups = {"box", "screen"};
  model.materials = {{"grey", radiosity::Color(0.5)}, {"screen", radiosity::Color(0.1), radiosity::Color(5.0)}};
  model.tells_sides = false;
  add_box(model, {0, 0, 0}, {1, 1, 1}, false);
  add_box(model, {0.2, 0.2, 0.95}, {0.8, 0.8, 1.05}, false, 1);
  std::vector<std::string> faults;
  const auto taken = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
  REQUIRE(taken);
  const raycast::Scene objects{radiosity::placed_objects(taken->scene)};
  const auto hit = objects.closest({{-1, 0.5, 0.5}, {2, 0, 0}});
  REQUIRE(hit);
  CHECK(hit->front);
  CHECK(hit->t == Approx(0.5));
}
