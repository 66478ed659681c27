// SPDX-License-Identifier: MIT
// Curved things that are small beside the patches of the scene have few facets, so that hundreds of them, such as castors and knobs, do
// not decide about the time; large ones and lamps are as fine as before.
#include <algorithm>
#include <cstddef>
#include <numbers>

#include <raycast/objects/box.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

using radiosity::Color;

// A room with a lamp and this many balls on its floor.
radiosity::Scene room_with_balls(double radius, int across) {
  radiosity::Scene scene;
  scene.materials = {{"grey", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{10.0}}};
  scene.objects = {scenes::object("room", raycast::BoxObject::make({0, 0, 0}, {4, 4, 3}).object, 0, true),
                   scenes::plate("lamp", {{1.5, 1.5, 2.9}, {1.5, 2.5, 2.9}, {2.5, 2.5, 2.9}, {2.5, 1.5, 2.9}}, 1)};
  for (int i = 0; i < across * across; ++i) {
    const glm::dvec3 middle{4.0 * (i % across + 0.5) / across, 4.0 * (i / across + 0.5) / across, 1.5 * radius};
    scene.objects.push_back(scenes::object("ball", raycast::Sphere::make(middle, radius).object));
  }
  return scene;
}

std::size_t faces_of(const radiosity::Scene& scene, double min_area, std::size_t object) {
  const radiosity::PrepareResult result = radiosity::prepare(scene, true, min_area);
  REQUIRE(result.prepared);
  return radiosity::radiating_faces(result.prepared->surfaces[object]);
}

}  // namespace

TEST_CASE("small curved things: the smaller one is beside the patches, the fewer facets it has, but never less than a chord of 3 % needs") {
  constexpr double min_area = 2e-4;  // patches some .1 m wide
  std::size_t before = 0, least = 10000;
  for (double radius = 0.001; radius < 1.2; radius *= 1.5) {
    const std::size_t faces = faces_of(room_with_balls(radius, 1), min_area, 2);
    CAPTURE(radius);
    CHECK(faces >= before);
    before = faces;
    least = std::min(least, faces);
  }
  const std::size_t finest = faces_of(room_with_balls(1.0, 1), 0.0, 2);
  CHECK(before == finest);
  CHECK(least >= 54);
  CHECK(4 * least <= finest);
  CHECK(faces_of(room_with_balls(0.001, 1), 1e-12, 2) == finest);  // where patches are finer, so are the facets
}

TEST_CASE("small curved things: a lamp is as fine as before, however small it is") {
  radiosity::Scene scene = room_with_balls(0.001, 1);
  const std::size_t dark = faces_of(scene, 2e-4, 2);
  scene.objects[2].material = {1};
  CHECK(faces_of(scene, 2e-4, 2) == faces_of(scene, 0.0, 2));
  CHECK(faces_of(scene, 2e-4, 2) > dark);
}

TEST_CASE("small curved things: balls of few facets have their true area, and darken the floor as those of many do", "[accuracy]") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  constexpr double radius = 0.02;
  constexpr int across = 10;
  const radiosity::Scene scene = room_with_balls(radius, across);
  radiosity::Options options{.epsilon = 0.04, .min_area = 3e-3, .audit_points = 0};
  options.seed = seed;
  const radiosity::Solution coarse = scenes::solved(scene, options);
  options.epsilon = 0.02;
  options.min_area = 2e-5;
  const radiosity::Solution fine = scenes::solved(scene, options);
  const auto ball = [](const radiosity::SurfaceMean& surface) { return surface.name == "ball" || surface.name.starts_with("ball#"); };
  double area = 0.0, light[2] = {0.0, 0.0};
  for (std::size_t k = 0; k < coarse.audit.surfaces.size(); ++k) {
    if (!ball(coarse.audit.surfaces[k])) { continue; }
    area += coarse.audit.surfaces[k].area;
    light[0] += coarse.audit.surfaces[k].area * coarse.audit.surfaces[k].radiosity.x;
    light[1] += fine.audit.surfaces[k].area * fine.audit.surfaces[k].radiosity.x;
  }
  CHECK(area == test::Approx(across * across * 4.0 * std::numbers::pi * radius * radius).epsilon(0.002));  // found: .07 % less
  CHECK(light[0] == test::Approx(light[1]).epsilon(0.01));  // found with five seeds: within .4 %
  CHECK(coarse.hierarchy.size() < fine.hierarchy.size() / 2);
  const Color floors[2] = {coarse.audit.surfaces[4].radiosity, fine.audit.surfaces[4].radiosity};
  CHECK(floors[0].x == test::Approx(floors[1].x).epsilon(0.005));  // within .15 %
}
