// SPDX-License-Identifier: MIT
// The meshes that stand in for curved objects where rays are cast.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/stand_in.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "lit_world.hpp"
#include "scenes.hpp"

namespace {

// Two or three solids that mostly cross each other, so that faces along the curves between them have many corners and are not convex.
raycast::CsgNode crossing(radiosity::Random& random) {
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const auto point = [&](double reach) { return glm::dvec3{between(-reach, reach), between(-reach, reach), between(-reach, reach)}; };
  raycast::CsgNode node{{}, "solid", static_cast<raycast::CsgOperation>(random.bits() % 3), {}, {}};
  const auto count = 2 + random.bits() % 2;
  for (std::uint64_t k = 0; k < count; ++k) {
    const glm::dvec3 at = point(0.4);
    const glm::dvec3 axis = radiosity::cosine_direction({0, 0, 1}, random.uniform(), random.uniform());
    const auto kind = random.bits() % 4;
    const auto solid = kind == 0   ? std::shared_ptr<const raycast::Object>(raycast::Sphere::make(at, between(0.3, 0.8)).object)
                       : kind == 1 ? raycast::Cylinder::make(at - axis, 2.0 * axis, between(0.2, 0.5)).object
                       : kind == 2 ? raycast::Torus::make(at, axis, between(0.5, 0.8), between(0.15, 0.3)).object
                                   : scenes::box(at - 0.4, at + glm::dvec3{between(0.2, 0.6), between(0.2, 0.6), between(0.2, 0.6)});
    node.parts.push_back({solid, "part", {}, {}, {}});
  }
  return node;
}

}  // namespace

TEST_CASE("meshes stand in for any curved solid, and rays meet them where they meet the solid", "[lamps]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(25, random(1, 1'000'000))));
  radiosity::Random random{seed, 0};
  CAPTURE(seed);
  const auto made = raycast::Csg::make(crossing(random));
  if (!made.object || made.object->flat()) { return; }
  const raycast::PlacedObject object{made.object};
  const double diameter = object.bounds().diameter(), tolerance = 0.0004 * diameter;
  const auto halves = radiosity::open_meshes(object, tolerance);
  REQUIRE(halves.size() == 2);
  const raycast::Scene exact{{object}}, stand_in{{raycast::PlacedObject{halves[0].mesh}, raycast::PlacedObject{halves[1].mesh}}};
  constexpr int rays = 2000;
  int otherwise = 0;
  std::vector<double> off;
  for (int i = 0; i < rays; ++i) {
    const glm::dvec3 d = radiosity::cosine_direction({0, 0, random.uniform() < 0.5 ? 1 : -1}, random.uniform(), random.uniform());
    const glm::dvec3 to = object.bounds().lo + glm::dvec3{random.uniform(), random.uniform(), random.uniform()} * object.bounds().size();
    const raycast::Segment ray{to - 2.0 * diameter * d, 4.0 * diameter * d};
    const auto a = exact.closest(ray), b = stand_in.closest(ray);
    if (!a && !b) { continue; }
    // Beside an outline the other surface behind it is met, or none.
    if (!a || !b || std::abs(a->t - b->t) * 4.0 * diameter > 0.02 * diameter) {
      ++otherwise;
      continue;
    }
    // The face knows of which sheet it is.
    const raycast::SurfacePoint on = object.project(halves[b->object].sheets[b->sheet], ray.at(b->t));
    CHECK(glm::length(on.position - ray.at(b->t)) < 4.0 * tolerance);
    const double across = std::abs(glm::dot(object.project(a->sheet, ray.at(a->t)).normal, d));
    off.push_back(across * std::abs(a->t - b->t) * 4.0 * diameter);
  }
  if (off.empty()) { return; }
  std::sort(off.begin(), off.end());
  CAPTURE(off.size(), otherwise, off.back() / tolerance);
  CHECK(otherwise <= rays / 100);
  CHECK(off[off.size() * 99 / 100] < 2.0 * tolerance);
}

// The two halves of a ball are two sheets of one sphere: which of them was met only the face knows, not the nearest sheet.
TEST_CASE("meshes that stand in know the sheets of solids that share a surface", "[lamps]") {
  const auto ball = raycast::Sphere::make({0, 0, 0}, 1.0).object;
  const auto half = [&](const glm::dvec3& from, const glm::dvec3& to) {
    raycast::CsgNode node{{}, "half", raycast::CsgOperation::intersect, {}, {}};
    node.parts.push_back({ball, "ball", {}, {}, {}});
    node.parts.push_back({scenes::box(from, to), "box", {}, {}, {}});
    return node;
  };
  raycast::CsgNode both{{}, "both", raycast::CsgOperation::unite, {}, {}};
  both.parts = {half({-2, -2, -2}, {2, 2, 0}), half({-2, -2, 0}, {2, 2, 2})};
  const auto made = raycast::Csg::make(both);
  REQUIRE(made.object);
  const raycast::PlacedObject object{made.object};
  const auto halves = radiosity::open_meshes(object, 0.001);
  REQUIRE(halves.size() == 2);
  const raycast::Scene exact{{object}}, stand_in{{raycast::PlacedObject{halves[0].mesh}, raycast::PlacedObject{halves[1].mesh}}};
  radiosity::Random random{3, 0};
  std::array<int, 2> met{};
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 d = radiosity::cosine_direction({0, 0, i % 2 == 0 ? 1 : -1}, random.uniform(), random.uniform());
    if (std::abs(d.z) < 0.01) { continue; }
    const raycast::Segment ray{3.0 * d, -3.0 * d};
    const auto a = exact.closest(ray), b = stand_in.closest(ray);
    REQUIRE((a && b));
    CHECK(halves[b->object].sheets[b->sheet] == a->sheet);
    met[d.z > 0.0 ? 1 : 0] += 1;
    CHECK(a->sheet != exact.closest({-3.0 * d, 3.0 * d})->sheet);
  }
  CHECK(std::min(met[0], met[1]) > 100);
}

// The mesh before the wall of a round hole has flat faces: beside its foot points of the bottom lie behind them, and saw their backs.
TEST_CASE("what is seen from the bottom of a round hole, at its very edge, are fronts, and it is as bright there as beside it", "[lamps]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(4, random(1, 1'000'000))));
  radiosity::Random random{seed, 1};
  CAPTURE(seed);
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const double radius = between(0.3, 0.8);
  raycast::CsgNode node{{}, "block", raycast::CsgOperation::subtract, {}, {}};
  node.parts.push_back({scenes::box({-1, -1, -0.5}, {1, 1, 0.4}), "box", {}, {}, {}});
  node.parts.push_back({raycast::Cylinder::make({0, 0, 0}, {0, 0, 2}, radius).object, "hole", {}, {}, {}});
  const auto made = raycast::Csg::make(node);
  REQUIRE(made.object);
  radiosity::Scene scene{{{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}},
                         {}};
  scene.objects = {scenes::object("block", made.object, 0), scenes::square("lamp", {0, 0, 3}, 0.3, false, 1)};
  const scenes::World world{scene};
  REQUIRE(world.light.lift(0) > 0.0);
  const glm::dvec3 up{0, 0, 1};
  for (int i = 0; i < 100; ++i) {
    const double angle = 2.0 * std::numbers::pi * random.uniform(), gap = std::pow(10.0, between(-7.0, -3.0));
    const auto at = [&](double r) { return glm::dvec3{r * std::cos(angle), r * std::sin(angle), 0.0}; };
    const auto light_at = [&](double r) { return world.region(at(r), 1e-6).irradiance(world.in_frame(at(r)), up).x; };
    CAPTURE(radius, angle, gap);
    CHECK(light_at(radius * (1.0 - gap)) == Approx(light_at(radius * 0.99)).epsilon(0.05));
    const glm::dvec3 from = world.light.lifted(0, world.in_frame(at(radius * (1.0 - gap))), up);
    int backs = 0;
    for (int k = 0; k < 32; ++k) {
      const auto hit = world.light.objects().closest({from, 4.0 * radiosity::cosine_direction(up, random.uniform(), random.uniform())});
      backs += hit && !hit->front ? 1 : 0;
    }
    CHECK(backs == 0);
  }
}
