// SPDX-License-Identifier: MIT
// The automatic view shows the light of a scene, however little of it leaks out and however it reaches what is seen.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/scene/material.hpp>

#include "catch.hpp"
#include "houses.hpp"
#include "models.hpp"
#include "seed.hpp"

using houses::add_box;

namespace {

apps::Model empty_model() {
  apps::Model model;
  model.groups = {"house", "lamp"};
  model.materials = {{"grey", radiosity::Color(0.5)}, {"lamp", radiosity::Color(0.0), radiosity::Color(100.0)}};
  return model;
}

// A square that shines down or up.
void add_lamp(apps::Model& model, const glm::dvec3& middle, double width, bool up) {
  std::vector<std::uint32_t> corners;
  for (const glm::dvec3 corner : {glm::dvec3(-1, -1, 0), glm::dvec3(-1, 1, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, -1, 0)}) {
    corners.push_back(static_cast<std::uint32_t>(model.positions.size()));
    model.positions.push_back(middle + 0.5 * width * corner);
  }
  if (up) { std::reverse(corners.begin(), corners.end()); }
  model.polygon(corners, 1, 1);
}

apps::SceneFile taken(apps::Model model, const apps::ModelOptions& options = {}) {
  std::vector<std::string> faults;
  auto file = apps::to_scene(std::move(model), apps::UpAxis::z, options, faults);
  REQUIRE(file);
  return std::move(*file);
}

// A bar under the ceiling, of which both ends are bent down and shine. The middle of it is far from both.
void add_bent_lamp(apps::Model& model, const glm::dvec3& middle, double length, double width) {
  std::vector<std::uint32_t> rows;
  for (const auto& [x, z] :
       {std::pair{-0.5 * length - width, -width}, {-0.5 * length, 0.0}, {0.5 * length, 0.0}, {0.5 * length + width, -width}}) {
    for (const double y : {-0.5 * width, 0.5 * width}) {
      rows.push_back(static_cast<std::uint32_t>(model.positions.size()));
      model.positions.push_back(middle + glm::dvec3(x, y, z));
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<std::uint32_t> corners{rows[2 * k], rows[2 * k + 1], rows[2 * k + 3], rows[2 * k + 2]};
    model.polygon(corners, k == 1 ? 0 : 1, 1);
  }
}

enum class Light { slit, window, closed };

// A house of blocks with a room in it. In the wall that the automatic view looks at is a slit, or a wide window, or neither.
apps::Model house(std::mt19937& random, const glm::dvec3& room, double size, Light light) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  apps::Model model = empty_model();
  const bool slit = light == Light::slit;
  const double thick = 0.1 + 0.2 * unit(random), wide = slit ? 0.01 + 0.2 * unit(random) : (0.45 + 0.2 * unit(random)) * room.x,
               at = room.x * (slit ? 0.2 + 0.5 * unit(random) : 0.15);
  const auto block = [&](const glm::dvec3& lo, const glm::dvec3& hi) { add_box(model, size * lo, size * hi, false); };
  const glm::dvec3 out = room + glm::dvec3(thick);
  block({-thick, -thick, -thick}, {out.x, out.y, 0});
  block({-thick, -thick, room.z}, {out.x, out.y, out.z});
  block({-thick, -thick, 0}, {0, out.y, room.z});
  block({room.x, -thick, 0}, {out.x, out.y, room.z});
  block({0, room.y, 0}, {room.x, out.y, room.z});
  if (light == Light::closed) {
    block({0, -thick, 0}, {room.x, 0, room.z});
    add_bent_lamp(model, size * room * glm::dvec3(0.5, 0.5, 0.95), 0.7 * size * room.x, 0.2 * size);
    return model;
  }
  block({0, -thick, 0}, {at, 0, room.z});
  block({at + wide, -thick, 0}, {room.x, 0, room.z});
  block({at, -thick, 0.8 * room.z}, {at + wide, 0, room.z});
  if (slit && unit(random) < 0.5) { block({-2, -4, -0.1}, {room.x + 2, -thick - 1e-3, 0}); }  // on which light falls that leaks out
  add_lamp(model, size * room * glm::dvec3(0.3 + 0.4 * unit(random), 0.3 + 0.4 * unit(random), 0.9), 0.3 * size, unit(random) < 0.5);
  return model;
}

}  // namespace

TEST_CASE("a house that shows its light through a slit or a window alone, or not at all, is looked at from within") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 30; ++round) {
    const double size = std::exp(8.0 * unit(random) - 4.0);
    const glm::dvec3 room(3.0 + 3.0 * unit(random), 3.0 + 2.0 * unit(random), 2.3 + unit(random));
    const apps::SceneFile file = taken(house(random, room, size, static_cast<Light>(round % 3)));
    CAPTURE(round, size, room.x, room.y, room.z);
    REQUIRE(file.cameras.size() == 1);
    const glm::dvec3 eye = file.cameras[0].eye / size;
    CHECK((eye.x > 0.0 && eye.x < room.x && eye.y > -0.3 && eye.y < room.y && eye.z > 0.0 && eye.z < room.z));  // or in the window
  }
}

// The lamp's back hides it from above; nothing that is seen but a part of the walls is lit directly.
TEST_CASE("a room whose lamp shines at the ceiling is looked at as a doll's house") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const double size = std::exp(8.0 * unit(random) - 4.0);
    const glm::dvec3 room = size * glm::dvec3(3.0 + 2.0 * unit(random), 3.0 + 2.0 * unit(random), 2.3 + unit(random));
    apps::Model model = empty_model();
    add_box(model, glm::dvec3(0.0), room, true);
    add_lamp(model, room * glm::dvec3(0.3 + 0.4 * unit(random), 0.3 + 0.4 * unit(random), 0.75 + 0.15 * unit(random)),
             size * (0.2 + 0.8 * unit(random)), true);
    const apps::SceneFile file = taken(std::move(model));
    CAPTURE(round, size, room.x / size, room.y / size, room.z / size);
    CHECK(file.cameras.empty());
  }
}

// Half of what is seen may lie in the shade, black if nothing but the model reflects light to it.
TEST_CASE("what a sun lights is looked at from outside") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const double size = std::exp(8.0 * unit(random) - 4.0);
    apps::Model model = empty_model();
    model.materials.pop_back();
    model.groups.pop_back();
    for (int block = 0; block < 4; ++block) {
      const glm::dvec3 lo(3.0 * unit(random), 3.0 * unit(random), 0.0);
      add_box(model, size * lo, size * (lo + glm::dvec3(0.3 + unit(random), 0.3 + unit(random), 0.3 + 2.0 * unit(random))), false);
    }
    apps::ModelLight sun;
    sun.kind = apps::ModelLight::Kind::sun;
    sun.intensity = radiosity::Color(1.0);
    const double turn = 6.28 * unit(random);
    sun.direction = {std::cos(turn), std::sin(turn), -0.3 - unit(random)};
    model.lights = {sun};
    const apps::SceneFile file = taken(std::move(model));
    CAPTURE(round, size, turn);
    CHECK((file.cameras.empty() || file.cameras[0].name == "automatic"));
  }
}
