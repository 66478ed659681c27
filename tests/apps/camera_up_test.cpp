// SPDX-License-Identifier: MIT
// Files written with another axis up than their format has: their cameras tell, and never in a file that is right.

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "apps/intake/camera_up.hpp"
#include "apps/intake/to_scene.hpp"
#include "catch.hpp"
#include "houses.hpp"
#include "models.hpp"
#include "seed.hpp"

namespace {

using apps::UpAxis;

// Looks in this direction, given by angles about z, rolled about its direction by some degrees.
radiosity::Camera camera(double turn, double pitch, double roll, UpAxis up) {
  const double degree = std::numbers::pi / 180.0, a = turn * degree, p = pitch * degree, r = roll * degree;
  const glm::dvec3 forward{std::cos(a) * std::cos(p), std::sin(a) * std::cos(p), std::sin(p)}, right{std::sin(a), -std::cos(a), 0.0};
  const auto placed = [&](const glm::dvec3& v) { return up == UpAxis::z ? v : glm::dvec3(v.x, v.z, -v.y); };
  return {.forward = placed(forward), .up = placed(std::cos(r) * glm::cross(right, forward) + std::sin(r) * right)};
}

}  // namespace

TEST_CASE("cameras that are level about the axis of their format never turn the file, wherever they look") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int run = 0; run < 2000; ++run) {
    const UpAxis up = run % 2 == 0 ? UpAxis::y : UpAxis::z;
    std::vector<radiosity::Camera> cameras;
    for (int i = 0; i <= run % 4; ++i) {
      const double turn = random() % 3 == 0 ? 90.0 * static_cast<double>(random() % 4) : 180.0 * unit(random);
      const double pitch = random() % 3 == 0 ? 90.0 * std::round(unit(random)) : 90.0 * unit(random);  // plans: straight down or up
      cameras.push_back(camera(turn, pitch, 0.0, up));
    }
    CHECK_FALSE(apps::up_of_cameras(cameras, up));
    // On its side, looking along an axis or horizontally.
    cameras = {camera(180.0 * unit(random), 0.0, random() % 2 == 0 ? 90.0 : -90.0, up)};
    CHECK_FALSE(apps::up_of_cameras(cameras, up));
    cameras = {camera(90.0 * static_cast<double>(random() % 4), 80.0 * unit(random), random() % 2 == 0 ? 90.0 : -90.0, up)};
    CHECK_FALSE(apps::up_of_cameras(cameras, up));
    cameras = {camera(90.0 * static_cast<double>(random() % 4), 0.0, 180.0 * unit(random), up)};
    CHECK_FALSE(apps::up_of_cameras(cameras, up));
  }
}

TEST_CASE("cameras at random, in a file with another axis up, tell it, rolled ones agree on none") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int told = 0, chance = 0;
  constexpr int runs = 2000;
  for (int run = 0; run < runs; ++run) {
    const UpAxis up = run % 2 == 0 ? UpAxis::y : UpAxis::z, other = run % 2 == 0 ? UpAxis::z : UpAxis::y;
    std::vector<radiosity::Camera> level, rolled;
    const double quarter = 90.0 * static_cast<double>(random() % 4), side = random() % 2 == 0 ? 1.0 : -1.0;
    for (int i = 0; i < 3; ++i) {
      // As people set them by hand: neither along an axis nor quite level.
      level.push_back(camera(quarter + 45.0 + 35.0 * unit(random), side * (45.0 + 30.0 * unit(random)), 2.0 * unit(random), other));
      rolled.push_back(
          camera(180.0 * unit(random), 60.0 * unit(random), (random() % 2 == 0 ? 1.0 : -1.0) * (30.0 + 20.0 * unit(random)), up));
    }
    level.push_back(camera(quarter, -90.0, 0.0, other));  // a plan
    told += apps::up_of_cameras(level, up) == other ? 1 : 0;
    chance += apps::up_of_cameras(rolled, up) ? 1 : 0;
  }
  CHECK(told > 0.98 * runs);
  // One in 15 rolled cameras is level to within 3 degrees about another axis, by chance, and three of them are one time in 3000.
  CHECK(chance < 0.005 * runs);
}

TEST_CASE("a file whose cameras agree on z is taken with z up, and says so, unless --up says otherwise") {
  for (const bool told : {false, true}) {
    apps::Model model = houses::house_without_lamp(false);  // z up
    radiosity::Camera view = camera(60.0, -30.0, 0.5, UpAxis::z);
    view.eye = {0.5, 0.5, 2.5};
    model.cameras = {view};
    apps::ModelOptions options;
    if (told) { options.up = UpAxis::y; }
    std::vector<std::string> faults;
    const auto file = apps::to_scene(std::move(model), UpAxis::y, options, faults);
    REQUIRE(file);
    CHECK(models::noted(file->notes, "its cameras stand upright about z") != told);
    CHECK(models::noted(file->notes, told ? "y is taken as up" : "z is taken as up"));
    CHECK((glm::length(file->cameras[0].eye - view.eye) < 1e-12) != told);
  }
}
