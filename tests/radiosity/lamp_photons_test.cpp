// SPDX-License-Identifier: MIT

// Photons tell which lamps light a place, so that those of other rooms add no noise to what is found there.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lamp_photons.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/near_light.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

using radiosity::PhotonGrid;

// A hall that walls divide into rooms, each 3 m wide with a lamp under its ceiling; that of the first is dim.
radiosity::Scene row_of_rooms(int count, double others) {
  using radiosity::Color;
  radiosity::Scene scene;
  scene.materials = {{"wall", Color{0.5}, Color{0.0}}, {"dim", Color{0.0}, Color{1.0}}, {"bright", Color{0.0}, Color{others}}};
  scene.objects.push_back(scenes::object("hall", scenes::box({0, 0, 0}, {3.2 * count - 0.2, 3, 2.5}), 0, true));
  for (int k = 0; k < count; ++k) {
    const double x = 3.2 * k;
    if (k > 0) { scene.objects.push_back(scenes::object("wall" + std::to_string(k), scenes::box({x - 0.2, 0, 0}, {x, 3, 2.5}), 0)); }
    scene.objects.push_back(scenes::square("lamp" + std::to_string(k), {x + 1.5, 1.5, 2.4}, 0.2, false, k == 0 ? 1 : 2));
  }
  return scene;
}

radiosity::MeetFront met_among(const raycast::Scene& objects) {
  return [&](const raycast::ScenePoint& from, const glm::dvec3& direction) -> std::optional<raycast::ScenePoint> {
    const raycast::Segment ray{from.position, direction * objects.diameter()};
    const auto hit = objects.closest(from, ray.direction);
    return hit && hit->front ? std::optional{objects.point(*hit, ray)} : std::nullopt;
  };
}

struct Spread {
  double mean = 0.0, deviation = 0.0, error = 0.0;  // error: of the mean
};
template <class Value>
Spread spread_of(int count, const Value& value) {
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < count; ++k) {
    const double v = value(static_cast<std::uint64_t>(k));
    sum += v / count;
    squares += v * v / count;
  }
  const double deviation = std::sqrt(std::max(0.0, squares - sum * sum));
  return {sum, deviation, deviation / std::sqrt(count - 1.0)};
}

// Path-traced radiosity at the point x of the floor, a sheet of the first object, by paths of at most so many reflections.
Spread path_traced(const radiosity::Scene& scene, const glm::dvec3& x, std::uint32_t sheet, std::uint64_t seed, std::uint32_t most) {
  const auto prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  const radiosity::Prepared& p = *prepared.prepared;
  const radiosity::PathTracer tracer{scene, p.objects, p.surfaces};
  return spread_of(20'000, [&](std::uint64_t k) {
    radiosity::Random numbers{seed, k};
    std::uint64_t rays = 0;
    return tracer.radiosity({{(x - p.frame.centre) * p.frame.scale, {0, 0, 1}}, 0, sheet}, numbers, rays, most).all.x;
  });
}

// What near light at the point x of the floor, the first object, needs.
struct NearFloor {
  radiosity::Scene scene;
  radiosity::Solution solution;
  radiosity::Lookup lookup{scene, solution.mesh, solution.frame};
  std::vector<radiosity::Material> materials;
  radiosity::DirectLight direct;
  PhotonGrid photons;

  NearFloor(const radiosity::Scene& of, const radiosity::Options& options) : scene{of}, solution{scenes::solved(of, options)} {
    std::vector<radiosity::Color> emission;
    for (const radiosity::InputSurface& input : radiosity::surfaces(scene)) {
      materials.push_back(scene.materials[input.material]);
      emission.push_back(materials.back().emission);
    }
    const std::vector<radiosity::Surface> boundaries = scenes::boundaries(lookup.objects());
    direct = radiosity::DirectLight{lookup.objects(), boundaries, emission, {.bodies = true}};
    std::vector<PhotonGrid::Photon> landed =
        radiosity::photons_by_lamp(boundaries, emission, met_among(lookup.objects()), lookup.objects().ray_work());
    for (PhotonGrid::Photon& photon : landed) {
      photon.source = static_cast<std::uint32_t>(direct.lamp_of(photon.source) - direct.lamps().data());
    }
    photons = PhotonGrid{landed, lookup.objects().diameter()};
  }
  [[nodiscard]] Spread at(const glm::dvec3& x, std::uint32_t sheet, std::uint64_t seed, bool guided) const {
    const PhotonGrid none;
    const radiosity::NearLight near{lookup, direct, materials, guided ? photons : none};
    const radiosity::NearLight::Seen seen{{{(x - solution.frame.centre) * solution.frame.scale, {0, 0, 1}}, 0, sheet},
                                          radiosity::Color{1.0}};
    return spread_of(256, [&](std::uint64_t k) { return near.light({&seen, 1}, 64, radiosity::scramble(seed) + k, nullptr).light.x; });
  }
};

}  // namespace

TEST_CASE("photons that landed around a place tell where its light comes from, in any order, and on the same side alone") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  // Two sheets that lie in each other: the upper side is lit by sources 0 and 1, from left to right more by 1; the lower one by 2.
  std::vector<PhotonGrid::Photon> photons;
  for (int i = 0; i < 40'000; ++i) {
    const glm::dvec3 p{random.uniform(), random.uniform(), 0.0};
    photons.push_back({p, {0, 0, 1}, random.uniform() < p.x ? 1u : 0u});
    photons.push_back({p, {0, 0, -1}, 2});
  }
  const double diameter = std::sqrt(2.0);
  const PhotonGrid grid{photons, diameter};
  std::reverse(photons.begin(), photons.end());
  const PhotonGrid again{photons, diameter};
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p{0.1 + 0.8 * random.uniform(), 0.1 + 0.8 * random.uniform(), 0.0};
    CAPTURE(p.x, p.y);
    const auto above = grid.around(p, {0, 0, 1}), below = grid.around(p, {0, 0, -1});
    REQUIRE_FALSE(above.shares.empty());
    CHECK(above.trust > 0.5);
    CHECK(above.share_of(0) + above.share_of(1) == test::Approx(1.0));
    // Cells are .022 to .18 wide; of the first ones some 20 photons tell, with a standard deviation of .11 at most.
    CHECK(std::abs(above.share_of(1) - p.x) < 0.6);
    REQUIRE(below.shares.size() == 1);
    CHECK(below.share_of(2) == test::Approx(1.0));
    CHECK(below.share_of(0) == 0.0);
    const auto other = again.around(p, {0, 0, 1});
    for (const std::uint32_t k : {0u, 1u}) { CHECK(other.share_of(k) == test::Approx(above.share_of(k))); }
  }
  // On the whole they say what is true.
  double off = 0.0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p{0.1 + 0.8 * random.uniform(), 0.1 + 0.8 * random.uniform(), 0.0};
    off += (grid.around(p, {0, 0, 1}).share_of(1) - p.x) / 200.0;
  }
  CHECK(std::abs(off) < 0.05);
  CHECK(grid.around({0.5, 0.5, 0.0}, {1, 0, 0}).trust == 0.0);
  CHECK(grid.around({9.0, 9.0, 9.0}, {0, 0, 1}).trust == 0.0);
  CHECK(PhotonGrid{std::span{photons}.first(8), diameter}.around(photons.front().position, photons.front().normal).trust == 0.0);
}

TEST_CASE("path tracing: the lamps of other rooms, however bright, add next to no noise, and no light") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(3, random(1, 1'000'000))));
  radiosity::Random random{seed, 0};
  const glm::dvec3 x{0.3 + 2.4 * random.uniform(), 0.3 + 2.4 * random.uniform(), 0.0};
  const double others = 3.0 * std::pow(30.0, random.uniform());
  CAPTURE(seed, x.x, x.y, others);
  Spread found[2];
  for (const bool many : {false, true}) {
    const radiosity::Scene scene = row_of_rooms(many ? 9 : 1, others);
    found[many] = path_traced(scene, x, 4, seed + many, 1000);
  }
  CAPTURE(found[0].mean, found[1].mean, found[0].deviation, found[1].deviation);
  CHECK(std::abs(found[0].mean - found[1].mean) < 5.0 * std::hypot(found[0].error, found[1].error));
  // An emitter that is chosen with the probability p adds a variance of 1 / p - 1 of the square of its light. Where a cell of photons
  // reaches into the next room p is less than 7/8: found up to .45 of the mean, by power over squared distance alone 1.3 to 2.6.
  CHECK(found[1].deviation < std::hypot(found[0].deviation, 0.8 * found[0].mean));
}

// The light that the ceiling sends back, by paths of near light. What the solutions of both scenes say of the rest differs.
TEST_CASE("near light: the lamps of other rooms, however bright, add next to no noise", "[picture][accuracy]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(3, random(1, 1'000'000))));
  radiosity::Random random{seed, 0};
  const glm::dvec3 x{0.3 * random.uniform(), 0.3 + 2.4 * random.uniform(), 0.0};
  const double others = 3.0 * std::pow(30.0, random.uniform());
  CAPTURE(seed, x.x, x.y, others);
  Spread found[2];
  for (const bool many : {false, true}) {
    const radiosity::Scene scene = row_of_rooms(many ? 9 : 1, others);
    const radiosity::Options options{.audit_points = 0};
    const NearFloor floor{scene, options};
    CHECK(floor.photons.empty() == !many);
    found[many] = floor.at(x, 4, seed, true);
  }
  CAPTURE(found[0].mean, found[1].mean, found[0].deviation, found[1].deviation);
  CHECK(std::abs(found[0].mean - found[1].mean) < 0.1 * found[0].mean);
  CHECK(found[1].deviation < 2.0 * found[0].deviation);  // up to 1.6; by strength alone 4.8 to 46
}

// So many that they are joined in groups; above a black ceiling there are as many, which light nothing below.
TEST_CASE("near light: of many lamps, every second of them hidden, it is that of the form factors", "[picture][accuracy]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(3, random(1, 1'000'000))));
  radiosity::Random random{seed, 0};
  using radiosity::Color;
  radiosity::Scene scene;
  scene.materials = {{"white", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{1.0}}, {"black", Color{0.0}, Color{0.0}}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 4.0, true)};
  const glm::dvec3 x{2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0, 0.0};
  const double half = 0.05 + 0.3 * random.uniform();
  double truth = 0.0;
  for (int k = 0; k < 128; ++k) {
    const glm::dvec3 middle{k % 8 - 3.5, k / 8 % 8 - 3.5, k < 64 ? 3.0 : 3.2};
    scene.objects.push_back(scenes::square("lamp" + std::to_string(k), middle, half, false, 1));
    if (k >= 64) { continue; }
    const std::vector<glm::dvec3> corners{middle + glm::dvec3{-half, half, 0}, middle + glm::dvec3{half, half, 0},
                                          middle + glm::dvec3{half, -half, 0}, middle + glm::dvec3{-half, -half, 0}};
    truth += 0.5 * radiosity::point_to_polygon(x, {0, 0, 1}, corners);
  }
  scene.objects.push_back(scenes::object("ceiling", scenes::box({-5, -5, 3.05}, {5, 5, 3.1}), 2));
  const radiosity::Options options{.epsilon = 0.3, .audit_points = 0};
  const NearFloor floor{scene, options};
  for (const bool guided : {false, true}) {
    const Spread found = floor.at(x, 0, seed, guided);
    CAPTURE(seed, half, guided, truth, found.mean, found.error);
    // 2 %: a group of lamps is seen by 16 points of it.
    CHECK(std::abs(found.mean - truth) < 5.0 * found.error + 0.02 * truth);
  }
}

// Lamps of single triangles that stand together: behind the plane of one the others are seen.
TEST_CASE("path tracing: a lamp of few triangles is as bright as its form factors say, all around it") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(3, random(1, 1'000'000))));
  radiosity::Random random{seed, 0};
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true)};
  const int count = 3 + static_cast<int>(4.0 * random.uniform());
  const double width = 0.05 + 0.1 * random.uniform(), height = 0.1 + 0.4 * random.uniform();
  const auto foot = [&](int k) {
    const double turn = 2.0 * std::numbers::pi * k / count;
    return glm::dvec3{width * std::cos(turn), width * std::sin(turn), 0.001};
  };
  std::vector<std::vector<glm::dvec3>> faces;
  for (int k = 0; k < count; ++k) {
    faces.push_back({foot(k), foot(k + 1), {0.0, 0.0, height}});
    scene.objects.push_back(scenes::object("face" + std::to_string(k), scenes::polygon(faces.back()), 1));
  }
  for (int i = 0; i < 12; ++i) {
    const double turn = 2.0 * std::numbers::pi * random.uniform(), away = width * 1.2 * std::pow(6.0, random.uniform());
    const glm::dvec3 x{away * std::cos(turn), away * std::sin(turn), 0.0};
    double truth = 0.0;
    for (const auto& face : faces) { truth += 0.5 * radiosity::point_to_polygon(x, {0, 0, 1}, face); }
    const Spread found = path_traced(scene, x, 0, seed + static_cast<std::uint64_t>(i), 1);
    CAPTURE(seed, count, width, height, x.x, x.y, truth, found.mean, found.error);
    CHECK(std::abs(found.mean - truth) < 5.0 * found.error);
  }
}

// A hall whose ceiling is full of lamps: photons in a cell are fewer than these.
TEST_CASE("path tracing: where lamps are more than photons can tell apart, these add little noise") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(2, random(1, 1'000'000))));
  radiosity::Random random{seed, 0};
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 20.0, true)};
  for (int k = 0; k < 1600; ++k) {
    scene.objects.push_back(scenes::square("lamp" + std::to_string(k), {k % 40 - 19.5, k / 40 - 19.5, 3.0}, 0.1, false, 1));
  }
  const glm::dvec3 x{20.0 * random.uniform() - 10.0, 20.0 * random.uniform() - 10.0, 0.0};
  const Spread found = path_traced(scene, x, 0, seed, 1);
  CAPTURE(seed, x.x, x.y, found.mean, found.deviation);
  CHECK(found.deviation < 2.5 * found.mean);  // the square root of 3.3 with as much trust as 16 photons deserve, of 11.6 with full trust
}
