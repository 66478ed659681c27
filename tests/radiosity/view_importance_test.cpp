// SPDX-License-Identifier: MIT

// Where the picture looks, stored rays are cast as finely as the picture asks: what lies around it, however large and bright, changes
// little.

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/mesh.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/rays/ray_choice.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

using radiosity::Color;

// A sky of some 100 faces over a meadow, with this radius.
std::shared_ptr<const raycast::Object> dome(double radius) {
  constexpr std::uint32_t rings = 6, sides = 18;
  std::vector<glm::dvec3> positions;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t r = 0; r < rings; ++r) {
    const double height = 0.5 * std::numbers::pi * r / rings;
    for (std::uint32_t s = 0; s < sides; ++s) {
      const double turn = 2.0 * std::numbers::pi * s / sides;
      positions.push_back(radius * glm::dvec3{std::cos(height) * std::cos(turn), std::cos(height) * std::sin(turn), std::sin(height)});
    }
  }
  positions.push_back({0.0, 0.0, radius});
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t s = 0; s < sides; ++s) {
      const std::uint32_t a = r * sides + s, b = r * sides + (s + 1) % sides;
      if (r + 1 == rings) {
        faces.push_back({b, a, static_cast<std::uint32_t>(positions.size() - 1)});
      } else {
        faces.push_back({b, a, a + sides, b + sides});
      }
    }
  }
  return raycast::Mesh::make(positions, faces).object;
}

// A room with a window to one side; its walls are seen from inside alone.
radiosity::Scene room_in_a_meadow(double radius, double window, double reflectance) {
  radiosity::Scene scene;
  scene.materials = {{"wall", Color{reflectance}, Color{0.0}}, {"meadow", Color{0.25}, Color{0.0}}, {"sky", Color{0.0}, Color{30.0}}};
  const double x = 4.0, y = 5.0, z = 2.7;
  const double a = 0.5 * (y - window), b = 0.5 * (y + window), low = 0.9, high = 2.2;
  const auto pane = [&](double y0, double y1, double z0, double z1) {
    return scenes::plate("wall", {{0, y0, z0}, {0, y1, z0}, {0, y1, z1}, {0, y0, z1}});
  };
  scene.objects = {scenes::plate("wall", {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}}),
                   scenes::plate("wall", {{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}}),
                   scenes::plate("wall", {{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}}),
                   scenes::plate("wall", {{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}}),
                   scenes::plate("wall", {{x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}}),
                   pane(0, a, 0, z),
                   pane(b, y, 0, z),
                   pane(a, b, 0, low),
                   pane(a, b, high, z),
                   scenes::object("wall", scenes::box({2.0, 3.0, 0.0}, {3.0, 3.8, 0.8})),
                   scenes::square("meadow", {0, 0, -0.1}, radius, true, 1),
                   scenes::object("sky", dome(radius), 2)};
  return scene;
}

radiosity::Viewpoint all_around(const glm::dvec3& eye) {
  return {eye, [eye](const glm::dvec3& p, const glm::dvec3& n) {
            const glm::dvec3 d = eye - p;
            const double r = glm::length(d);
            return std::max(0.0, glm::dot(n, d)) / (r * r * r);
          }};
}

}  // namespace

TEST_CASE("a picture of a room: the meadow around it, however large, takes nothing of what the room needs", "[slow]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>{a, b}(random); };
  double off_by_area = 0.0, off_by_view = 0.0, norm = 0.0;
  double rays_by_area = 0.0, rays_by_view = 0.0;
  for (int i = 0; i < 6; ++i) {
    const radiosity::Scene scene = room_in_a_meadow(20.0 * std::pow(10.0, uniform(0.0, 1.0)), uniform(0.8, 2.0), uniform(0.5, 0.75));
    radiosity::Options options;
    options.audit_points = 0;
    options.reconstruction = radiosity::Reconstruction::none;
    options.indirect = radiosity::Indirect::rays;
    options.seed = random();
    radiosity::Control from_inside;
    from_inside.viewpoint = all_around({2.0, 2.5, 1.4});  // the middle of the room
    const auto solved = [&](double epsilon, const radiosity::Control& control) {
      options.epsilon = epsilon;
      options.min_area = 2.0 * epsilon * epsilon;
      return scenes::solved(scene, options, control);
    };
    const radiosity::Solution by_area = solved(0.01, {}), by_view = solved(0.01, from_inside), truth = solved(0.0015, from_inside);
    REQUIRE(by_view.audit.stored_rays > 0);
    rays_by_area += static_cast<double>(by_area.audit.stored_rays);
    rays_by_view += static_cast<double>(by_view.audit.stored_rays);
    const double floor = truth.audit.surfaces.front().radiosity.x;  // so that all rooms count alike
    for (std::size_t k = 0; k < truth.audit.surfaces.size(); ++k) {
      const radiosity::SurfaceMean& exact = truth.audit.surfaces[k];
      if (exact.name != "wall") { continue; }  // some faces of the box are not seen, and one lies on the floor
      const auto square = [&](double b) { return exact.area * b * b / (floor * floor); };
      norm += square(exact.radiosity.x);
      off_by_area += square(by_area.audit.surfaces[k].radiosity.x - exact.radiosity.x);
      off_by_view += square(by_view.audit.surfaces[k].radiosity.x - exact.radiosity.x);
    }
    UNSCOPED_INFO("so far " << std::sqrt(off_by_area / norm) << " by area, " << std::sqrt(off_by_view / norm) << " by the picture");
  }
  // Found over the walls, as the root of the relative square: .13 to .20 by the picture, .30 to .56 by the area, with a third of the rays.
  CHECK(off_by_view < 0.6 * off_by_area);
  CHECK(rays_by_view < 0.6 * rays_by_area);
}

TEST_CASE("a picture under a roof hardly depends on how large the plain around it is", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>{a, b}(random); };
  constexpr double under = 2.5;  // height of the roof, which is black above
  constexpr int turns = 8;
  double brighter = 0.0;
  for (int turn = 0; turn < turns; ++turn) {
    const double half = uniform(2.0, 5.0), x = uniform(-0.3, 0.3), y = uniform(-0.3, 0.3);  // not in the middle of the plain
    const auto lit_under_roof = [&](double plain) {
      radiosity::Scene scene;
      scene.materials = {{"roof", Color{0.7}, Color{0.0}},
                         {"plain", Color{0.4}, Color{0.0}},
                         {"sky", Color{0.0}, Color{30.0}},
                         {"black", Color{0.0}, Color{0.0}}};
      const glm::dvec3 at{x * plain, y * plain, 0.0};
      const auto corner = [&](double u, double v, double z) { return at + glm::dvec3{u * half, v * half, z}; };
      scene.objects = {scenes::plate("roof", {corner(-1, -1, under), corner(-1, 1, under), corner(1, 1, under), corner(1, -1, under)}),
                       scenes::plate("black", {corner(-1, -1, under), corner(1, -1, under), corner(1, 1, under), corner(-1, 1, under)}, 3),
                       scenes::square("plain", {0, 0, 0}, plain, true, 1), scenes::object("sky", dome(1.5 * plain), 2)};
      const radiosity::Options options{.epsilon = 0.01,
                                       .min_area = 2e-4,
                                       .indirect = radiosity::Indirect::rays,
                                       .reconstruction = radiosity::Reconstruction::none,
                                       .audit_points = 0,
                                       .seed = seed};
      radiosity::Control from_below;
      from_below.viewpoint = all_around(at + glm::dvec3{0.1, 0.2, 1.6});
      return scenes::solved(scene, options, from_below).audit.surfaces.front().radiosity.x;
    };
    brighter += lit_under_roof(600.0 * half) / lit_under_roof(6.0 * half) / turns;
  }
  // The truth is 1.02, by tracing 4 million paths from each of eight roofs to the plain, and on to the sky or back. Found 1.05 to 1.17 with
  // twelve seeds; by the area alone 1.40, for then the plain under the roof is lit as all of it. When rays from the plain to the sky
  // counted for the plain under the roof, too, its row sums were up to 1.8; limited to 1, they left single roofs .75 to 1.3 of their light.
  CHECK(brighter > 0.98);
  CHECK(brighter < 1.22);
}

TEST_CASE("light goes by stored rays, too, where most input faces shine: under a sky of many faces") {
  CHECK(radiosity::choose_rays({.all = 1000, .shining = 700, .lamps = 0, .uncut_shining = 700}, {}).cast);
  CHECK(radiosity::choose_rays({.all = 1000, .shining = 20, .lamps = 20, .uncut_shining = 20}, {}).cast);
  CHECK(radiosity::choose_rays({.all = 700, .shining = 690, .lamps = 0, .uncut_shining = 690}, {}).cast);
  CHECK_FALSE(radiosity::choose_rays({.all = 250, .shining = 240, .lamps = 0, .uncut_shining = 240}, {}).cast);  // little below the sky
  const radiosity::RayChoice bulb = radiosity::choose_rays({.all = 700, .shining = 690, .lamps = 690, .uncut_shining = 690}, {});
  CHECK((!bulb.cast && bulb.few && bulb.many_lamps));  // rays if a run finds much light beside the bulb
}

// While shares of the picture were taken by unit of area in metres, but areas in the unit of the solution, a room told in thousandths had 22
// times as many leaves.
TEST_CASE("a solution for a camera does not depend on the unit of length") {
  const auto solved_in = [](double unit) {
    radiosity::Scene scene = room_in_a_meadow(20.0, 1.5, 0.6);
    for (radiosity::SceneObject& object : scene.objects) { object.placement.linear *= unit; }
    radiosity::Control control;
    control.viewpoint = all_around(unit * glm::dvec3{1.5, 1.5, 1.6});
    return scenes::solved(scene, {.indirect = radiosity::Indirect::rays, .audit_points = 0}, control);
  };
  const radiosity::Solution expected = solved_in(1.0);
  CHECK(expected.audit.rays_for_view);
  for (const int exponent : {-20, -10, 3, 10}) {
    INFO("unit 2^" << exponent);
    const radiosity::Solution solution = solved_in(std::ldexp(1.0, exponent));
    REQUIRE(solution.radiosity.size() == expected.radiosity.size());
    CHECK(solution.radiosity == expected.radiosity);
  }
}
