// SPDX-License-Identifier: MIT
// Models without a lamp get one where they are seen.

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/scene.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/intake/light_views.hpp"
#include "catch.hpp"
#include "houses.hpp"
#include "models.hpp"
#include "seed.hpp"

using houses::add_box;
using houses::house_without_lamp;
using models::noted;

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
  const auto seed = test::seed();
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

// Walls, floor and ceiling are boxes with a thickness, and there is a doorway, so no shell is a closed room.
TEST_CASE("where the cameras of a file see nothing but darkness, the picture is taken of the model in its studio, unless the user chose") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 12; ++round) {
    const bool dark = round % 2 == 0, chosen = round % 3 == 0;
    const glm::dvec3 size = glm::dvec3(0.5) + 2.0 * glm::dvec3(unit(random), unit(random), unit(random));
    const glm::dvec3 middle(size.x + 0.01, 0.5 * size.y,
                            0.5 * size.z);  // in a gap of 2 cm between two blocks below a third, where it is dark
    apps::Model model;
    model.groups = {"blocks"};
    model.materials = {{"grey", radiosity::Color(0.5)}};
    add_box(model, glm::dvec3(0.0), size, false);
    add_box(model, {size.x + 0.02, 0.0, 0.0}, {2.0 * size.x + 0.02, size.y, size.z}, false);
    add_box(model, {0.0, 0.0, size.z}, {2.0 * size.x + 0.02, size.y, size.z + 0.3}, false);
    radiosity::Camera camera;
    camera.name = "given";
    const double turn = 6.28 * unit(random);
    camera.eye = dark ? middle : middle + 8.0 * glm::dvec3(std::cos(turn), std::sin(turn), 0.2);
    camera.forward = dark ? glm::dvec3(turn > 3.14 ? 1.0 : -1.0, 0.0, 0.0) : middle - camera.eye;
    if (!chosen) { model.cameras = {camera}; }
    apps::ModelOptions options;
    if (chosen) { options.camera = camera; }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, options, faults);
    REQUIRE(file);
    REQUIRE(noted(file->notes, "put into a studio"));
    CAPTURE(round, dark, chosen, size.x, size.y, size.z, turn);
    CHECK(noted(file->notes, "next to nothing") == dark);
    CHECK((file->cameras.front().name == "given") == (!dark || chosen));
    if (!dark || chosen) { continue; }
    CHECK(file->cameras.back().name == "given");
    const radiosity::View view = radiosity::make_view(file->cameras.front(), {100, 100});
    std::vector<raycast::PlacedObject> objects;
    for (const radiosity::SceneObject& object : file->scene.objects) { objects.emplace_back(object.shape, object.placement); }
    const auto hit = raycast::Scene(std::move(objects)).closest({view.eye, view.direction(50.0, 50.0)});
    REQUIRE(hit);
    CHECK(hit->front);
    const glm::dvec3 seen = view.eye + hit->t * view.direction(50.0, 50.0);
    CHECK(seen.z > 1e-6);  // not the floor of the studio
  }
}

TEST_CASE("a room with a doorway and without a lamp is lit if the camera of the file stands in it") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 12; ++round) {
    const double size = std::exp(8.0 * unit(random) - 4.0), door = 0.5 + unit(random);
    const glm::dvec3 room = glm::dvec3(3.0 + 3.0 * unit(random), 3.0 + 2.0 * unit(random), 2.3 + unit(random));
    apps::Model model;
    model.groups = {"house"};
    model.materials = {{"grey", radiosity::Color(0.5)}};
    houses::add_walls_with_doorway(model, room, door, size);
    add_box(model, size * glm::dvec3(0.6 * room.x, 0.6 * room.y, 0), size * glm::dvec3(0.8 * room.x, 0.8 * room.y, 0.8), false);
    const bool inside = round % 3 != 0;
    radiosity::Camera camera;
    camera.name = "given";
    camera.eye = size * (inside ? room * glm::dvec3(0.3 + 0.2 * unit(random), 0.3 + 0.2 * unit(random), 0.6) : glm::dvec3(-8, -6, 4));
    camera.forward = 0.5 * size * room - camera.eye;
    model.cameras = {camera};
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CAPTURE(round, size, door, room.x, room.y, room.z);
    CHECK(noted(file->notes, inside ? "hangs under its ceiling" : "put into a studio"));
    CHECK_FALSE(noted(file->notes, "next to nothing"));
    CHECK(apps::LightViews(file->scene).lit_share(file->cameras.front()) > 0.2);
    if (inside) {
      const glm::dvec3 lamp = file->scene.objects.back().shape->bounds().centre() / size;
      CHECK((lamp.x > 0.0 && lamp.x < room.x && lamp.y > 0.0 && lamp.y < room.y && lamp.z > 0.5 * room.z && lamp.z < room.z));
    }
  }
}

// A house of many parts with a lantern beside its door, which lights a spot of one wall, from inside a box open below.
TEST_CASE("a model of which its own lamps light hardly anything is put into a studio, unless the user chose them") {
  for (const bool lantern : {false, true}) {
    const auto house = [&] {
      apps::Model model;
      model.groups = {"house", "lamp"};
      model.materials = {{"stone", radiosity::Color(0.5)}, {"lamp", radiosity::Color(0.5), radiosity::Color(10.0)}};
      add_box(model, {0, 0, 0}, {10, 10, 8}, false);
      for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < 8; ++j) {
          const double a = i + 0.3, z = j + 0.3;
          add_box(model, {a, -0.1, z}, {a + 0.4, 0, z + 0.4}, false);
          add_box(model, {a, 10, z}, {a + 0.4, 10.1, z + 0.4}, false);
          add_box(model, {-0.1, a, z}, {0, a + 0.4, z + 0.4}, false);
          add_box(model, {10, a, z}, {10.1, a + 0.4, z + 0.4}, false);
        }
      }
      if (lantern) {
        add_box(model, {4.8, -0.5, 2.6}, {5.2, -0.1, 2.7}, false);
        add_box(model, {4.9, -0.4, 2.5}, {5.1, -0.2, 2.6}, false, 1);
      } else {
        add_box(model, {-20, -20, 30}, {30, 30, 31}, false, 1);
      }
      return model;
    };
    std::vector<std::string> faults;
    const auto file = apps::to_scene(house(), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CHECK(noted(file->notes, "put into a studio") == lantern);
    apps::ModelOptions chosen;
    chosen.lamps = {{"lamp", 10.0}};
    const auto as_chosen = apps::to_scene(house(), apps::UpAxis::z, chosen, faults);
    REQUIRE(as_chosen);
    CHECK_FALSE(noted(as_chosen->notes, "put into a studio"));
  }
}

// A closed box with walls of a thickness: alone it is a room.
TEST_CASE("a model with a hollow part, such as the tank of a car, is put into a studio, the hollow thing alone lit within") {
  for (const bool alone : {false, true}) {
    apps::Model model;
    model.groups = {"car"};
    model.materials = {{"grey", radiosity::Color(0.5)}};
    add_box(model, {0, 0, 0}, {1, 1, 0.5}, false);
    add_box(model, {0.05, 0.05, 0.05}, {0.95, 0.95, 0.45}, true);
    if (!alone) { add_box(model, {-2, -1, 0.6}, {3, 2, 2}, false); }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), apps::UpAxis::z, {}, faults);
    REQUIRE(file);
    CHECK(noted(file->notes, "put into a studio") == !alone);
    CHECK(noted(file->notes, "hangs under its ceiling") == alone);
  }
}
