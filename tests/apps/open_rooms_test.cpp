// SPDX-License-Identifier: MIT
// Rooms of which one side is missing, as stages, doll's houses and Cornell boxes have it, are looked at away from the opening.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/scene.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/intake/light_views.hpp"
#include "catch.hpp"
#include "models.hpp"
#include "program.hpp"
#include "seed.hpp"

namespace {

struct OpenRoom {
  glm::dvec3 size{0.0};
  int open = 6;            // -x, +x, -y, +y, floor, ceiling, none
  std::string obj, scene;  // z up
};

// A box with a lamp under its ceiling and boxes on its floor, of six polygons or of five.
OpenRoom open_room(std::mt19937& random, int open) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double scale = std::exp(4.0 * unit(random) - 2.0);
  OpenRoom room{scale * glm::dvec3(2.0 + 6.0 * unit(random), 2.0 + 6.0 * unit(random), 2.0 + 2.0 * unit(random)), open, {}, {}};
  const auto text = [](double x) { return std::to_string(x); };
  room.scene = "material grey reflectance 0.5\nmaterial lamp emission 10\n";
  int polygons = 0;
  const auto polygon = [&](const std::vector<glm::dvec3>& corners, const std::string& material) {
    const std::string name = "p" + std::to_string(polygons++);
    room.obj += "o " + name + "\nusemtl " + material + "\n";
    room.scene += "polygon " + name + " material " + material + " {\n";
    std::string face = "f";
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::string at = text(corners[i].x) + " " + text(corners[i].y) + " " + text(corners[i].z) + "\n";
      room.obj += "v " + at;
      room.scene += " vertex " + at;
      face += " -" + std::to_string(corners.size() - i);
    }
    room.obj += face + "\n";
    room.scene += "}\n";
  };
  const auto box = [&](const glm::dvec3& lo, const glm::dvec3& hi, bool inwards, int missing) {
    constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int k = 0; k < 6; ++k) {
      std::vector<glm::dvec3> corners;
      for (const int c : sides[k]) {
        corners.emplace_back((c & 1) != 0 ? hi.x : lo.x, (c & 2) != 0 ? hi.y : lo.y, (c & 4) != 0 ? hi.z : lo.z);
      }
      if (inwards) { std::reverse(corners.begin(), corners.end()); }
      if (k != missing) { polygon(corners, "grey"); }
    }
  };
  box(glm::dvec3(0.0), room.size, true, open);
  const int things = open == 4 ? 0 : static_cast<int>(random() % 4);
  for (int i = 0; i < things; ++i) {
    const glm::dvec3 lo = room.size * glm::dvec3(0.02 + 0.7 * unit(random), 0.02 + 0.7 * unit(random), 0.001);
    box(lo, lo + room.size * glm::dvec3(0.1 + 0.15 * unit(random), 0.1 + 0.15 * unit(random), 0.1 + 0.4 * unit(random)), false, 6);
  }
  const double half = scale * (0.1 + 0.3 * unit(random));
  const glm::dvec3 lamp = room.size * glm::dvec3(0.25 + 0.5 * unit(random), 0.25 + 0.5 * unit(random), 0.99 - 0.05 * unit(random));
  polygon({lamp + half * glm::dvec3(-1, -1, 0), lamp + half * glm::dvec3(-1, 1, 0), lamp + half * glm::dvec3(1, 1, 0),
           lamp + half * glm::dvec3(1, -1, 0)},
          "lamp");
  return room;
}

apps::SceneFile taken(const OpenRoom& room, bool as_obj) {
  if (!as_obj) {
    apps::SceneResult result = apps::parse_scene(room.scene);
    REQUIRE(result.file);
    return std::move(*result.file);
  }
  apps::ModelOptions options;
  options.lamps = {{"lamp", 10.0}};
  options.up = apps::UpAxis::z;
  return models::scene("a.obj", room.obj, {}, options);
}

double fronts(const raycast::Scene& objects, const radiosity::Camera& camera) {
  const radiosity::View view = radiosity::make_view(camera, {32, 24});
  int met = 0;
  for (int i = 0; i < 32 * 24; ++i) {
    const auto hit = objects.closest({view.eye, view.direction(i % 32 + 0.5, i / 32 + 0.5)});
    met += hit && hit->front ? 1 : 0;
  }
  return met / (32.0 * 24.0);
}

}  // namespace

// The other views: level, from anywhere at the height of an eye, with more than half of the narrower width of the room before them.
TEST_CASE("a view from within meets surfaces where any view of the room does, whichever side is open") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 70; ++round) {
    const OpenRoom room = open_room(random, round % 7);
    const bool as_obj = round / 7 % 2 == 0;
    const apps::SceneFile file = taken(room, as_obj);
    const raycast::Scene objects{radiosity::placed_objects(file.scene)};
    double most = 0.0;
    for (int i = 0; i < 300; ++i) {
      radiosity::Camera other{.eye = room.size * glm::dvec3(unit(random), unit(random), 0.4 + 0.4 * unit(random)), .field_of_view = 80.0};
      const double angle = 2.0 * std::numbers::pi * unit(random);
      other.forward = {std::cos(angle), std::sin(angle), 0.0};
      const auto ahead = objects.closest({other.eye, other.forward});
      if (ahead && ahead->front && ahead->t > 0.5 * std::min(room.size.x, room.size.y)) { most = std::max(most, fronts(objects, other)); }
    }
    const auto inside = apps::LightViews(file.scene).inside();
    CAPTURE(round, room.open, as_obj, most, room.size.x, room.size.y, room.size.z);
    REQUIRE(inside);
    CHECK(fronts(objects, inside->camera) > (most > 0.95 ? 0.9 : 0.85 * most));
  }
}

// A long room that lacks an end is best seen through a long wall, a little askew.
TEST_CASE("the picture of a room with an open side looks away from it, from within or from outside, and shows light") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 70; ++round) {
    const OpenRoom room = open_room(random, round % 7);
    const bool as_obj = round / 7 % 2 == 0;
    const apps::SceneFile file = taken(room, as_obj);
    const radiosity::Camera camera = file.cameras.empty() ? radiosity::automatic_camera(file.scene) : file.cameras.front();
    CAPTURE(round, room.open, as_obj, camera.name, room.size.x, room.size.y, room.size.z);
    CHECK(apps::LightViews(file.scene).lit_share(camera) > 0.5);
    if (room.open < 4) {
      const double out = room.open % 2 == 0 ? -1.0 : 1.0;
      CHECK(glm::normalize(camera.forward)[room.open / 2] * out < 0.5);
    }
  }
}

// The walls of such a file show both sides, so that none hides less than another, and a studio lights all of them. Rooms about as wide as
// deep, because the opening of a long one is small from outside.
TEST_CASE("without a lamp, too, a room with an open side is seen through that, though its walls have two sides") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  int rooms = 0;
  for (int round = 0; rooms < 24; ++round) {
    const OpenRoom room = open_room(random, round % 4);
    const double depth = room.size[room.open / 2], width = room.size[1 - room.open / 2];
    if (depth > 1.3 * width || width > 1.3 * depth || 2.0 * room.size.z < width) { continue; }
    ++rooms;
    apps::ModelOptions options;
    options.up = apps::UpAxis::z;
    options.lamps = {{"lamp", 0.0}};
    const apps::SceneFile file = models::scene("a.obj", room.obj, {}, options);
    CHECK(models::noted(file.notes, "put into a studio"));
    CAPTURE(round, room.open, room.size.x, room.size.y, room.size.z);
    REQUIRE_FALSE(file.cameras.empty());
    CHECK(file.cameras[0].forward[room.open / 2] * (room.open % 2 == 0 ? -1.0 : 1.0) < 0.0);
  }
}

TEST_CASE("a scene of halflight without a camera is looked at from where its light is seen") {
  const program::Place place;
  const std::string room =
      "material grey reflectance 0.5\nmaterial lamp emission 10\nbox room from 0 0 0 to 4 3 2.5 inside material grey\n"
      "polygon lamp material lamp {\n vertex 1 1 2.4\n vertex 1 2 2.4\n vertex 2 2 2.4\n vertex 2 1 2.4\n}\n";
  const std::string house =
      "material grey reflectance 0.5\nmaterial lamp emission 10\n"
      "difference house material grey {\n box block from -0.2 -0.2 -0.2 to 4.2 3.2 2.7\n box room from 0 0 0 to 4 3 2.5\n}\n" +
      room.substr(room.find("polygon"));
  place.write("room.scene", room);
  place.write("house.scene", house);
  place.write("with.scene", house + "camera own eye 9 9 9 target 0 0 0\n");
  const std::string coarse = " --size 24x18 --epsilon 0.1 --quiet --audit 0 --threads 1";
  CHECK(place.run("render room.scene -o a.png" + coarse).out.find("camera automatic") != std::string::npos);
  const program::Run run = place.run("render house.scene -o a.png" + coarse);
  CHECK(run.out.find("camera inside") != std::string::npos);
  CHECK(run.out.find("the camera stands in the room of a lamp") != std::string::npos);
  CHECK(place.run("render with.scene -o a.png" + coarse).out.find("camera own") != std::string::npos);
}
