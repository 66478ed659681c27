// SPDX-License-Identifier: MIT
// The view of a scene that has no camera.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <raycast/objects/box.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"

namespace {

using radiosity::Color;

constexpr std::uint32_t wall = 0, lamp = 1;  // materials

radiosity::Scene scene_of(std::vector<radiosity::SceneObject> objects) {
  return {{{"wall", Color{0.5}, Color{0.0}}, {"lamp", Color{0.1}, Color{1000.0}}}, std::move(objects)};
}

radiosity::SceneObject sphere(const glm::dvec3& centre, double radius, std::uint32_t material) {
  return scenes::object("sphere", raycast::Sphere::make(centre, radius).object, material);
}

radiosity::SceneObject wall_box(const glm::dvec3& low, const glm::dvec3& high) {
  return scenes::object("box", raycast::BoxObject::make(low, high).object, wall);
}

}  // namespace

TEST_CASE("the automatic view shows the whole scene") {
  const radiosity::View v = radiosity::make_view(radiosity::automatic_camera(scene_of({wall_box({100, -5, 3}, {104, 1, 9})})), {});
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec3 p = v.to_view({(i & 1U) != 0 ? 104.0 : 100.0, (i & 2U) != 0 ? 1.0 : -5.0, (i & 4U) != 0 ? 9.0 : 3.0});
    CHECK(p.z > 0.0);
    CHECK(std::abs(p.x) < v.half_width * p.z);
    CHECK(std::abs(p.y) < v.half_height() * p.z);
  }
}

TEST_CASE("the automatic view looks into a room that is open on one side from there") {
  for (int open = 0; open < 4; ++open) {
    CAPTURE(open);
    const auto turned = [&](const glm::dvec3& p) {
      const double a = 0.5 * std::numbers::pi * open;
      return glm::dvec3{p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
    };
    std::vector<radiosity::SceneObject> walls;
    const auto add = [&](std::vector<glm::dvec3> corners) {
      for (glm::dvec3& p : corners) { p = turned(p); }
      walls.push_back(scenes::object("wall", scenes::polygon(std::move(corners)), 0));
    };
    // Open to -y, before it is turned.
    add({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    add({{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}});
    add({{-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2}});
    add({{-1, -1, 0}, {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2}});
    add({{1, -1, 0}, {1, -1, 2}, {1, 1, 2}, {1, 1, 0}});
    const glm::dvec3 forward = radiosity::automatic_camera(scene_of(std::move(walls))).forward;
    CHECK(glm::dot(forward, turned({0, 1, 0})) > 0.4);  // it looks in askew
  }
}

TEST_CASE("the automatic view shows a lamp near the things it lights, and the same as without one far away, or a wide ground") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto within = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int run = 0; run < 20; ++run) {
    std::vector<radiosity::SceneObject> things{wall_box({-4, -4, -4}, {-3, -3, 4})};
    for (int i = 0; i < 3; ++i) {
      const double x = within(-4, 4), y = within(-4, 4), z = within(-4, 4);
      things.push_back(sphere({x, y, z}, 0.5, wall));
    }
    const radiosity::Camera alone = radiosity::automatic_camera(scene_of(things));
    const auto with_lamp = [&](double height) {
      std::vector<radiosity::SceneObject> all = things;
      all.push_back(sphere({0, 0, height}, 1.0, lamp));
      return radiosity::automatic_camera(scene_of(all));
    };
    CHECK(with_lamp(within(60, 1000)).eye == alone.eye);
    std::vector<radiosity::SceneObject> on_ground = things;
    on_ground.push_back(scenes::square("ground", {0, 0, -5}, within(40, 10'000), true));
    CHECK(radiosity::automatic_camera(scene_of(on_ground)).eye == alone.eye);
    // The walls of a room are no grounds.
    std::vector<radiosity::SceneObject> room{scenes::square("floor", {0, 0, -5}, 30.0, true),
                                             scenes::square("top", {0, 0, 55}, 30.0, false)};
    for (int k = 0; k < 4; ++k) {
      const double turn = 0.5 * std::numbers::pi * k;
      const glm::dvec3 out{30.0 * std::cos(turn), 30.0 * std::sin(turn), 25.0}, along{-out.y, out.x, 0.0}, up{0, 0, 30};
      room.push_back(scenes::plate("wall" + std::to_string(k), {out - along - up, out - along + up, out + along + up, out + along - up}));
    }
    const radiosity::Camera whole = radiosity::automatic_camera(scene_of(room));
    room.insert(room.end(), things.begin(), things.end());
    CHECK(radiosity::automatic_camera(scene_of(room)).eye == whole.eye);
    // Nor is one that is a single object with a lamp in it.
    radiosity::SceneObject hall = scenes::object("hall", scenes::box({-30, -30, -5}, {30, 30, 55}), wall, true);
    hall.material = {wall, wall, wall, wall, wall, lamp};
    std::vector<radiosity::SceneObject> in_hall{hall};
    const radiosity::Camera of_hall = radiosity::automatic_camera(scene_of(in_hall));
    in_hall.insert(in_hall.end(), things.begin(), things.end());
    CHECK(radiosity::automatic_camera(scene_of(in_hall)).eye == of_hall.eye);
    // A sky that is one object with its ground.
    const double half = within(40, 10'000);
    on_ground.back() = scenes::object("sky", scenes::box({-half, -half, -5}, {half, half, half}), lamp, true);
    on_ground.back().material = {lamp, lamp, lamp, lamp, wall, lamp};
    CHECK(radiosity::automatic_camera(scene_of(on_ground)).eye == alone.eye);
    const radiosity::View near = radiosity::make_view(with_lamp(6.0), {});
    CHECK(std::abs(near.to_view({0, 0, 7}).y) < near.half_height() * near.to_view({0, 0, 7}).z);
  }
}
