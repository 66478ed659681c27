// SPDX-License-Identifier: MIT
// Models of rooms and houses: from where they are looked at, and where they get a lamp that they have not.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
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
#include "models.hpp"

using models::noted;
using models::scene;

namespace {

// A box that looks inwards, as a room does, or outwards. Group 1 is of material 1, others of material 0.
void add_box(apps::Model& model, const glm::dvec3& lo, const glm::dvec3& hi, bool inwards, std::uint32_t group = 0) {
  constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  for (int i = 0; i < 8; ++i) {
    model.positions.emplace_back((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z);
  }
  for (const auto& side : sides) {
    std::vector<std::uint32_t> corners;
    for (const int c : side) { corners.push_back(first + static_cast<std::uint32_t>(c)); }
    if (inwards) { std::reverse(corners.begin(), corners.end()); }
    model.polygon(corners, group == 1 ? 1 : 0, group);
  }
}

// As small a house as has what matters: a room with a thing in it, no lamp; walls of a thickness around it, or not.
apps::Model house_without_lamp(bool walls) {
  apps::Model model;
  model.groups = {"house"};
  model.materials = {{"grey", radiosity::Color(0.5)}};
  add_box(model, {0, 0, 0}, {4, 4, 3}, true);
  add_box(model, {2, 2, 0.1}, {3, 3, 1}, false);
  if (walls) { add_box(model, {-0.2, -0.2, -0.2}, {4.2, 4.2, 3.2}, false); }
  return model;
}

}  // namespace

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

// Flat boxes close under the ceiling, as ceiling lamps are, over furniture.
TEST_CASE("the camera in a house stands at the height of an eye and sees what lamps shine on") {
  const unsigned seed = std::random_device{}();
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

// Rooms without lamps as models have them: looking inwards, with things in them, some up to the ceiling, turned and of any size.
TEST_CASE("a closed room in which nothing shines gets a lamp in its air") {
  const unsigned seed = 7;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const double size = std::exp(8.0 * unit(random) - 4.0);
    const glm::dvec3 extent{4.0 * size, 3.0 * size, 2.5 * size};
    apps::Model model;
    model.groups = {"room"};
    model.materials = {{"grey", radiosity::Color(0.5)}};
    add_box(model, glm::dvec3(0.0), extent, true);
    for (int i = 0; i < 5; ++i) {
      const glm::dvec3 lo = extent * glm::dvec3(0.05 + 0.7 * unit(random), 0.05 + 0.7 * unit(random), 0.02);
      add_box(model, lo,
              lo + extent * glm::dvec3(0.05 + 0.15 * unit(random), 0.05 + 0.15 * unit(random), i == 0 ? 0.97 : 0.9 * unit(random)), false);
    }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CHECK(radiosity::faults(file->scene).empty());
    CHECK(noted(file->notes, "hangs under its ceiling"));
    const radiosity::SceneObject& lamp = file->scene.objects.back();
    std::vector<raycast::PlacedObject> placed;
    for (const auto& object : file->scene.objects) { placed.emplace_back(object.shape, object.placement); }
    const raycast::Scene objects(std::move(placed));
    const auto index = static_cast<std::uint32_t>(file->scene.objects.size() - 1);
    CHECK_FALSE(objects.covered(lamp.shape->bounds().centre(), {0, 0, -1}, index));
    const auto below = objects.closest({lamp.shape->bounds().centre(), {0, 0, -1}}, index, 0);
    REQUIRE(below);
    CHECK(below->front);
    CHECK(below->t > 0.05 * size);
  }
}

TEST_CASE("in a corridor without a lamp of its own the lamp hangs in the middle, whatever lies along the walls") {
  const auto seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const double length = 8.0 + 20.0 * unit(random);
    const bool along_x = round % 2 == 0;
    const auto turned = [&](const glm::dvec3& p) { return along_x ? glm::dvec3(p.y, p.x, p.z) : p; };
    apps::Model model;
    model.groups = {"corridor"};
    model.materials = {{"grey", radiosity::Color(0.5)}};
    add_box(model, glm::dvec3(0.0), turned({2.0, length, 2.5}), true);
    for (int door = 0; door < 8; ++door) {
      const double at = (length - 1.0) * unit(random);
      add_box(model, turned({0.0, at, 0.0}), turned({0.01 + 0.05 * unit(random), at + 0.9, 2.0}), false);
    }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    REQUIRE(noted(file->notes, "hangs under its ceiling"));
    const glm::dvec3 middle = turned(file->scene.objects.back().shape->bounds().centre());
    CAPTURE(length, middle.x, middle.y);
    CHECK(std::abs(middle.y - 0.5 * length) < length / 8.0);
  }
}

TEST_CASE("a house of thick walls without a lamp is lit where it is seen") {
  const auto taken = [](apps::Model model) {
    std::vector<std::string> faults;
    auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CHECK(radiosity::faults(file->scene).empty());
    return std::move(*file);
  };
  const auto in_room = [](const glm::dvec3& p) { return p.x > 0.0 && p.x < 4.0 && p.y > 0.0 && p.y < 4.0 && p.z > 0.0 && p.z < 3.0; };
  const apps::SceneFile house = taken(house_without_lamp(true));
  CHECK(noted(house.notes, "hangs under its ceiling"));
  CHECK(in_room(house.scene.objects.back().shape->bounds().centre()));
  REQUIRE(house.cameras.size() == 1);
  CHECK(in_room(house.cameras[0].eye));

  for (const bool inside : {false, true}) {  // seen from where the file's camera stands
    apps::Model model = house_without_lamp(true);
    radiosity::Camera camera;
    camera.name = "given";
    camera.eye = inside ? glm::dvec3(1, 1, 1.5) : glm::dvec3(-8, -6, 4);
    camera.forward = glm::dvec3(2, 2, 1.5) - camera.eye;
    model.cameras = {camera};
    const apps::SceneFile file = taken(std::move(model));
    CHECK(noted(file.notes, inside ? "hangs under its ceiling" : "put into a studio"));
    CHECK(file.cameras.size() == 1);
    CHECK_FALSE(noted(file.notes, "next to nothing"));
  }
  const apps::SceneFile doll = taken(house_without_lamp(false));
  CHECK(noted(doll.notes, "hangs under its ceiling"));
  CHECK(doll.cameras.empty());
}

// A round lamp of many polygons in a house: in whatever order a program wrote them, the picture is the same.
TEST_CASE("the camera in a house does not depend on the order of polygons, and one that sees no light is told") {
  const unsigned seed = std::random_device{}();
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
    const radiosity::Camera& inside = file->cameras.back();
    CHECK(inside.name == "inside");
    if (!first) { first = inside; }
    CHECK(glm::length(inside.eye - first->eye) < 1e-6);
    CHECK(glm::length(inside.forward - first->forward) < 1e-6);
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
