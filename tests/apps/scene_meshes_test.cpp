// SPDX-License-Identifier: MIT
// Meshes from files within a scene: what encloses a camera or a lamp of the scene is seen from inside, wherever its group is used.

#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/scene.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/scene/bounds.hpp>

#include "models.hpp"
#include "seed.hpp"

namespace {

std::string text_of(const glm::dvec3& v) {
  char text[80];
  static_cast<void>(std::snprintf(text, sizeof text, "%.17g %.17g %.17g", v.x, v.y, v.z));
  return text;
}

// A box from 0 0 0 to 2 3 4 that looks outwards, and another from 5 0 0 to 7 3 4, each a group.
std::string two_boxes() {
  std::string text;
  for (int box = 0; box < 2; ++box) {
    text += "o box" + std::to_string(box) + "\n";
    for (int i = 0; i < 8; ++i) {
      text += "v " + text_of(glm::dvec3((i & 1) * 2.0 + 5.0 * box, (i >> 1 & 1) * 3.0, (i >> 2 & 1) * 4.0)) + "\n";
    }
    for (const char* const face : {"-8 -6 -5 -7", "-4 -3 -1 -2", "-8 -7 -3 -4", "-6 -2 -1 -5", "-8 -4 -2 -6", "-7 -5 -1 -3"}) {
      text += std::string("f ") + face + "\n";
    }
  }
  return text;
}

// Where the clauses of a statement put a point.
glm::dvec3 placed(const glm::dvec3& point, const std::string& clauses) {
  const auto probe = apps::parse_scene("material m\nsphere s center 0 0 0 radius 1 material m" + clauses + "\n", {});
  REQUIRE(probe.file);
  const raycast::Placement& placement = probe.file->scene.objects[0].placement;
  return placement.linear * point + placement.translation;
}

}  // namespace

TEST_CASE("a mesh in a group is a room in those uses that hold a camera or a lamp, and a solid in the others") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int round = 0; round < 20; ++round) {
    std::string scene = "material m reflectance 0.5\nmaterial lamp reflectance 0 emission 5\n";
    const int uses = 1 + static_cast<int>(random() % 4);
    const bool nested = round % 2 == 1;
    scene += "define g { mesh a file boxes.obj move 1 1 1 material m }\n";
    if (nested) { scene += "define h { use g as inner rotate 0 0 1 30 scale 2 }\n"; }
    std::string things;
    std::vector<bool> room;             // of each box of each use
    std::vector<raycast::Segment> out;  // of each, from its middle
    for (int u = 0; u < uses; ++u) {
      const glm::dvec3 move(40.0 * u, number(-5, 5), number(-5, 5)), axis(number(-1, 1), number(-1, 1), 1.0);
      const std::string clauses = " scale " + std::to_string(number(0.2, 1.0)) + " rotate " + text_of(axis) + " " +
                                  std::to_string(number(0, 360)) + " move " + text_of(move);
      scene += "use " + std::string(nested ? "h" : "g") + " as u" + std::to_string(u) + clauses + "\n";
      for (int box = 0; box < 2; ++box) {
        const int what = static_cast<int>(random() % 3);  // nothing, a camera, a lamp
        room.push_back(what > 0);
        const std::string around = (nested ? " rotate 0 0 1 30 scale 2" : "") + clauses, name = std::to_string(u) + std::to_string(box);
        const glm::dvec3 middle = placed(glm::dvec3(2.0 + 5.0 * box, 2.5, 3.0), around);
        out.push_back({middle, placed(glm::dvec3(2.0 + 5.0 * box, 8.5, 3.0), around) - middle});
        const glm::dvec3 inside(number(1.5, 2.5) + 5.0 * box, number(1.5, 3.5), number(1.5, 4.5));
        if (what == 1) { things += "camera c" + name + " eye " + text_of(placed(inside, around)) + " look 0 1 0\n"; }
        if (what == 2) {
          things += "disk l" + name + " center " + text_of(inside) + " normal 0 0 -1 radius 0.2 material lamp" + around + "\n";
        }
      }
    }
    CAPTURE(round, scene, things);
    const auto result = apps::parse_scene(scene + things, models::beside({{"boxes.obj", two_boxes()}}));
    INFO(apps::to_text(result, "s"));
    REQUIRE(result.file);
    CHECK(radiosity::faults(result.file->scene).empty());
    // One form of the mesh serves all uses that hold something: a box is a room in all of them once it is in one.
    std::vector<bool> any(2, false), expected;
    for (std::size_t i = 0; i < room.size(); ++i) { any[i % 2] = any[i % 2] || room[i]; }
    for (std::size_t i = 0; i < room.size(); ++i) { expected.push_back((room[i] || room[i ^ 1U]) && any[i % 2]); }
    // From the middle of a room the fronts of its walls are seen.
    const raycast::Scene objects(radiosity::placed_objects(result.file->scene));
    std::vector<bool> found;
    for (const raycast::Segment& ray : out) {
      const auto hit = objects.closest(ray);
      found.push_back(hit && hit->front && hit->t <= 1.0);  // beyond is another use
    }
    CHECK(found == expected);
  }
}

// The foot of such a lamp lies in the top of the box, so the point before it is in the box.
TEST_CASE("a mesh on which a lamp stands is a solid, one in which it stands is a room") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int round = 0; round < 40; ++round) {
    const bool within = round % 2 == 0;
    const double z = within ? 0.0 : 4.0;
    const glm::dvec3 foot{number(0.1, 0.8), number(0.1, 1.2), z}, size{number(0.1, 1.0), number(0.1, 1.5), number(0.1, 3.0)};
    std::string lamp = "box shade from " + text_of(foot) + " to " + text_of(foot + size);
    if (round % 4 > 1) { lamp = "cylinder shade base " + text_of(foot) + " axis 0 0 " + std::to_string(size.z) + " radius 0.05"; }
    const std::string scene = "material m reflectance 0.5\nmaterial lamp reflectance 0 emission 5\nmesh a file boxes.obj material m\n" +
                              lamp + " material lamp\n";
    INFO(scene);
    const auto read = apps::parse_scene(scene, models::beside({{"boxes.obj", two_boxes()}}));
    REQUIRE(read.file);
    // From a place in the box, beside the lamp: does its wall show the front?
    const auto hit = raycast::Scene(radiosity::placed_objects(read.file->scene)).closest({{1.9, 2.9, 2.0}, {0.0, 0.5, 0.0}});
    CHECK((hit && hit->front && hit->t <= 1.0) == within);
  }
}

// The middle of such a lamp lies in the box, and most of its faces have their middles there.
TEST_CASE("a mesh that a lamp pierces is a solid where a room holds both, and a room where nothing does") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int round = 0; round < 24; ++round) {
    const bool room = round % 2 == 0, shape = round % 4 == 0;
    const glm::dvec3 lo{number(-0.5, -0.1), number(0.2, 1.0), number(0.2, 2.0)}, hi{number(2.1, 2.5), number(1.5, 2.5), number(2.5, 3.5)};
    std::string scene = "material m reflectance 0.5\nmaterial lamp reflectance 0 emission 5\nmesh a file boxes.obj material m\n";
    scene += "box bracket from " + text_of(lo) + " to " + text_of(hi) + " material lamp\n";
    if (room) {
      scene +=
          shape ? "box room from -2 -2 -1 to 9 9 9 inside material m\n" : "mesh room file boxes.obj scale 6 move -2 -2 -1 material m\n";
    }
    INFO(scene);
    const auto read = apps::parse_scene(scene, models::beside({{"boxes.obj", two_boxes()}}));
    REQUIRE(read.file);
    const auto hit = raycast::Scene(radiosity::placed_objects(read.file->scene)).closest({{1.0, 2.9, 0.1}, {0.0, 0.5, 0.0}});
    CHECK((hit && hit->front && hit->t <= 1.0) == !room);
  }
}
