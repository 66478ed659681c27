// SPDX-License-Identifier: MIT

// Meshes that are cut along the edges of shadows: the laws of topology and area, the limit, and the error at equal leaves.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/shadow.hpp>

#include "catch.hpp"
#include "generations.hpp"
#include "scenes.hpp"
#include "solved.hpp"

using radiosity::Color;
using radiosity::Options;
using radiosity::Scene;
using radiosity::Solution;

namespace {

constexpr std::uint32_t thing_material = 0, lamp_material = 1;

// A room, so that faces share edges, with a lamp below its ceiling, a box that stands on its floor and a plate that hangs askew.
Scene random_room(std::uint64_t seed) {
  radiosity::Random random{seed, 0, 0};
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  Scene scene{{{"white", Color{0.6, 0.5, 0.4}, Color{0.0}}, {"lamp", Color{random.bits() % 2 == 0 ? 0.0 : 0.3}, Color{9.0}}}, {}};
  const glm::dvec3 foot{between(0.1, 0.5), between(0.1, 0.5), 0.0};
  const glm::dvec3 corner{between(0.2, 0.5), between(0.2, 0.5), between(0.4, 0.6)};
  const glm::dvec3 s{between(0.1, 0.3), between(0.0, 0.2), between(0.0, 0.1)};
  const glm::dvec3 t{between(-0.2, 0.0), between(0.1, 0.3), between(0.0, 0.1)};
  scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, {1, 1, 1}), thing_material, true),
                   scenes::square("lamp", {between(0.3, 0.7), between(0.3, 0.7), 0.95}, between(0.05, 0.2), false, lamp_material),
                   scenes::object("box", scenes::box(foot, foot + glm::dvec3{between(0.1, 0.4), between(0.1, 0.4), between(0.1, 0.3)})),
                   scenes::plate("plate", {corner, corner + s, corner + s + t, corner + t})};
  return scene;
}

Options coarse(std::uint32_t discontinuities) {
  return {.epsilon = 0.08, .min_area = 4e-3, .discontinuities = discontinuities, .audit_points = 0};
}

// The half-shadow of examples/scenes/penumbra.scene.
Scene half_shadow() {
  Scene scene{{{"floor", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{10.0}}, {"blocker", Color{0.0}, Color{0.0}}}, {}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 1.5, true, 0), scenes::square("lamp", {0, 0, 2}, 0.4, false, 1),
                   scenes::square("blocker", {0, 0, 0.5}, 0.4, true, 2)};
  return scene;
}

// Relative L2 errors on its floor, whose exact radiosity is half the exitance times the form factor past the blocker: of the constant on
// each leaf, and of that from the exact mean over the leaf.
struct FloorErrors {
  double leaves = 0.0, means = 0.0;
};
FloorErrors errors_on_floor(const Solution& solution) {
  const std::vector<glm::dvec3> over{{-0.4, -0.4, 2}, {-0.4, 0.4, 2}, {0.4, 0.4, 2}, {0.4, -0.4, 2}};
  const std::vector<glm::dvec3> between{{-0.4, -0.4, 0.5}, {0.4, -0.4, 0.5}, {0.4, 0.4, 0.5}, {-0.4, 0.4, 0.5}};
  const radiosity::Blocker one{between, {0, 0, 1}};
  radiosity::ShadowedTarget target{over, {0, 0, -1}, {&one, 1}, 1e-12};
  std::vector<double> light(solution.hierarchy.size(), 0.0), area(solution.hierarchy.size(), 0.0);
  double error = 0.0, all = 0.0;
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    if (face.surface != 0) { continue; }
    const auto at = [&](std::uint32_t k) { return solution.mesh.positions[solution.mesh.corners[face.first_corner + k].vertex]; };
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const double part = glm::length(glm::cross(at(k) - at(0), at(k + 1) - at(0))) / 32.0;
      for (int i = 0; i < 16; ++i) {  // strata of a square, mapped evenly to the triangle
        const double u = std::sqrt((i % 4 + 0.5) / 4.0), v = (i / 4 + 0.5) / 4.0;
        const glm::dvec3 x = (1.0 - u) * at(0) + u * (1.0 - v) * at(k) + u * v * at(k + 1);
        const double exact = 5.0 * target.form_factor(x, {0, 0, 1});
        const double off = solution.radiosity[face.node].x - exact;
        error += part * off * off;
        all += part * exact * exact;
        light[face.node] += part * exact;
        area[face.node] += part;
      }
    }
  }
  double of_means = 0.0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double off = area[i] > 0.0 ? solution.radiosity[i].x - light[i] / area[i] : 0.0;
    of_means += area[i] * off * off;
  }
  return {std::sqrt(error / all), std::sqrt(of_means / all)};
}

}  // namespace

TEST_CASE("discontinuity meshing keeps topology and area, and does not depend on threads") {
  const std::uint64_t seed = 0xd15c0;
  CAPTURE(seed);
  for (std::uint64_t k = 0; k < 6; ++k) {
    CAPTURE(k);
    const Scene scene = random_room(seed + k);
    Options options = coarse(1000);
    options.threads = 1;
    int generations = 0;
    const Solution solution = scenes::solved(scene, options, watch_generations(generations));
    CHECK(generations > 3);
    REQUIRE(solution.audit.imprinted);
    CHECK(solution.audit.imprinted->edges > 10);
    CHECK(solution.audit.imprinted->limited == 0);
    for (const radiosity::Node& node : solution.hierarchy) {
      if (node.leaf()) { continue; }
      double parts = 0.0;
      for (std::uint32_t c = 0; c < node.child_count; ++c) { parts += solution.hierarchy[node.first_child + c].area; }
      CHECK(std::abs(parts - node.area) <= 1e-10 * node.area);  // roundings of coordinates, in parts of a thousandth of the size
    }
    options.threads = 3;
    CHECK((scenes::solved(scene, options).radiosity == solution.radiosity));  // not to be printed
  }
}

TEST_CASE("discontinuity meshing: the limit holds on each face, and is told") {
  const Scene scene = random_room(7);
  const Solution few = scenes::solved(scene, coarse(2));
  REQUIRE(few.audit.imprinted);
  CHECK(few.audit.imprinted->edges <= 2 * few.audit.imprinted->faces);
  CHECK(few.audit.imprinted->limited > 0);
  CHECK_FALSE(scenes::solved(scene, coarse(0)).audit.imprinted);
}

TEST_CASE("discontinuity meshing by BF-refinement: valid, edges are imprinted") {
  Options options = coarse(1000);
  options.refinement = radiosity::Refinement::a_posteriori;
  options.target = 0.1;
  int generations = 0;
  const Solution solution = scenes::solved(random_room(3), options, watch_generations(generations));
  REQUIRE(solution.audit.imprinted);
  CHECK(solution.audit.imprinted->edges > 0);
}

TEST_CASE("discontinuity meshing of a half-shadow: about half the error with no more leaves", "[accuracy]") {
  struct Pair {
    double regular, cut;  // epsilon
  };
  for (const Pair& pair : {Pair{0.01, 0.0043}, Pair{0.005, 0.00287}}) {
    const auto options = [](double epsilon) {
      return Options{
          .epsilon = epsilon, .min_area = 2.4 * epsilon * epsilon, .reconstruction = radiosity::Reconstruction::none, .audit_points = 0};
    };
    const Solution regular = scenes::solved(half_shadow(), options(pair.regular));
    Options with = options(pair.cut);
    with.discontinuities = 1000;
    const Solution cut = scenes::solved(half_shadow(), with);
    CAPTURE(regular.audit.leaves, cut.audit.leaves, errors_on_floor(regular).leaves);
    CHECK(cut.audit.leaves <= regular.audit.leaves);
    CHECK(errors_on_floor(cut).leaves < 0.55 * errors_on_floor(regular).leaves);
  }
}

TEST_CASE("discontinuity meshing: the light on each leaf of a half-shadow is the mean of the exact light") {
  Options options = coarse(1000);
  options.epsilon = 0.04;
  options.reconstruction = radiosity::Reconstruction::none;
  const FloorErrors errors = errors_on_floor(scenes::solved(half_shadow(), options));
  // Over leaves that err by 3 % as constants, means of 36 points differ from those of the 32 points above by some 3 % / sqrt(12 * 32), at
  // most; links of 64 segments would err by 1.5 % here.
  CHECK(errors.leaves < 0.04);
  CHECK(errors.means < 0.003);
}

TEST_CASE("discontinuity meshing refuses what it cannot be joined with") {
  Options options = coarse(10);
  CHECK(radiosity::faults(options).empty());
  options.topology = radiosity::Topology::separate;
  CHECK(radiosity::faults(options).size() == 1);
}
