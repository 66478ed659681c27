// SPDX-License-Identifier: MIT

// Directions towards emitters: their density is what it says, and with it the path tracer finds the light of any lamp, however small, near
// or bright beside others, without rare paths that count much.

#include <cmath>
#include <cstdint>

#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>

#include <radiosity/audit/emitters.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "many_scene.hpp"
#include "scenes.hpp"

using radiosity::Color;
using radiosity::Scene;

namespace {

radiosity::Prepared prepare_scene(const Scene& scene) {
  auto result = radiosity::prepare(scene);
  REQUIRE(result.prepared);
  return std::move(*result.prepared);
}

glm::dvec3 in_frame(const radiosity::Prepared& p, const glm::dvec3& x) { return (x - p.frame.centre) * p.frame.scale; }

// A white plate of side 2 about the origin that faces up, and black lamps.
Scene plate_under_lamps(double exitance) {
  Scene scene{{{"plate", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{exitance}}}, {}};
  scene.objects = {scenes::square("plate", {0, 0, 0}, 1.0, true)};
  return scene;
}

// Radiosity at the point x of the plate: mean and standard error of `count` paths, and the largest estimate.
struct PathTraced {
  double mean = 0.0, error = 0.0, largest = 0.0;
};
PathTraced path_traced(const Scene& scene, const glm::dvec3& x, int count, std::uint64_t seed) {
  const radiosity::Prepared p = prepare_scene(scene);
  const radiosity::PathTracer tracer{scene, p.objects, p.surfaces};
  double sum = 0.0, square = 0.0;
  PathTraced result;
  std::uint64_t rays = 0;
  for (int i = 0; i < count; ++i) {
    radiosity::Random random{seed, static_cast<std::uint64_t>(i)};
    const double b = tracer.radiosity({{in_frame(p, x), {0, 0, 1}}, 0, 0}, random, rays).all.x;
    sum += b;
    square += b * b;
    result.largest = std::max(result.largest, b);
  }
  result.mean = sum / count;
  result.error = std::sqrt((square / count - result.mean * result.mean) / count);
  return result;
}

}  // namespace

TEST_CASE("emitters: samples over their density give the solid angle in which there are any") {
  Scene scene = plate_under_lamps(1.0);
  scene.materials.push_back({"dim", Color{0.3}, Color{0.01}});
  scene.objects.push_back(scenes::object("box", scenes::box({0.3, 0.2, 0.4}, {0.8, 0.5, 0.9}), 1));
  scene.objects.push_back(scenes::object("ball", raycast::Sphere::make({-0.4, 0.3, 0.6}, 0.25).object, 1));
  scene.objects.push_back(scenes::object("ring", raycast::Torus::make({0, -0.5, 0.8}, {0, 0.3, 1}, 0.4, 0.05).object, 2));
  scene.objects.push_back(scenes::object("tube", raycast::Cylinder::make({-0.9, -0.9, 0.2}, {1.8, 0, 0}, 0.02).object, 1));
  scene.objects.push_back(scenes::object("bulb", scenes::ball({0.6, -0.4, 0.7}, 0.15, 6), 1));  // of 120 triangles
  const radiosity::Prepared p = prepare_scene(scene);
  std::vector<Color> emission;
  for (const auto& s : radiosity::surfaces(scene)) { emission.push_back(scene.materials[s.material].emission); }
  const radiosity::Emitters emitters{p.surfaces, emission};
  INFO("seed 11");
  radiosity::Random random{11, 0};
  for (int k = 0; k < 6; ++k) {
    const glm::dvec3 x =
        in_frame(p, {2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0, k % 2 == 0 ? 0.0 : 0.6 * random.uniform()});
    const double u = random.uniform();
    const glm::dvec3 n = k % 2 == 0 ? glm::dvec3{0, 0, 1} : radiosity::cosine_direction({0, 0, 1}, u, random.uniform());
    // f = 1 in directions of the hemisphere in which the density is above 0, by even directions and by samples over their density. The
    // share of samples that give a direction at all is the integral of the density.
    constexpr int count = 40000;
    double even = 0.0, even_density = 0.0, density_square = 0.0, sampled = 0.0, sampled_square = 0.0, given = 0.0;
    for (int i = 0; i < count; ++i) {
      const double z = random.uniform(), angle = 2.0 * std::numbers::pi * random.uniform(), r = std::sqrt(1.0 - z * z);
      const auto [s, t] = radiosity::orthonormal(n);
      const glm::dvec3 w = r * std::cos(angle) * s + r * std::sin(angle) * t + z * n;
      const double density = emitters.density(x, n, w);
      even += density > 0.0 ? 2.0 * std::numbers::pi / count : 0.0;
      even_density += 2.0 * std::numbers::pi * density / count;
      density_square += std::pow(2.0 * std::numbers::pi * density, 2) / count;
      const auto sample = emitters.sample(x, n, random);
      if (!sample) { continue; }
      CHECK(sample->density == test::Approx(emitters.density(x, n, sample->direction)).epsilon(1e-6));
      given += 1.0 / count;
      sampled += 1.0 / (sample->density * count);
      sampled_square += 1.0 / (sample->density * sample->density * count);
    }
    const double whole = 2.0 * std::numbers::pi;
    const double doubt = std::sqrt((sampled_square - sampled * sampled + whole * whole / 4.0) / count);
    CAPTURE(k, even, sampled, doubt, even_density, given);
    CHECK(std::abs(even - sampled) < 4.5 * doubt);
    CHECK(std::abs(even_density - given) < 4.5 * std::sqrt((density_square + 1.0) / count));
  }
}

TEST_CASE("path tracing: a sphere lamp of any size and distance lights a plate as the inverse square law says") {
  // Irradiance under a sphere of radius r whose centre is at the distance d, at the angle t to the normal: M (r/d)^2 cos t.
  INFO("seed 21");
  radiosity::Random random{21, 0};
  for (int k = 0; k < 12; ++k) {
    const double r = std::pow(10.0, -4.0 + 3.5 * random.uniform());
    const glm::dvec3 centre{random.uniform() - 0.5, random.uniform() - 0.5, r + 0.01 + random.uniform()};
    const glm::dvec3 x{random.uniform() - 0.5, random.uniform() - 0.5, 0};
    Scene scene = plate_under_lamps(2.0 / (r * r));
    scene.objects.push_back(scenes::object("lamp", raycast::Sphere::make(centre, r).object, 1));
    const double d = glm::length(centre - x);
    const double expected = 0.5 * 2.0 / (d * d) * (centre.z / d);
    const PathTraced result = path_traced(scene, x, 4000, 31);
    CAPTURE(k, r, d, expected, result.mean, result.error);
    CHECK(std::abs(result.mean - expected) < 4.5 * result.error + 1e-9 * expected);
    CHECK(result.error < 0.05 * expected);  // with 4000 paths: no path counts more than about ten times the mean
  }
}

TEST_CASE("path tracing: a bright speck beside a large dim wall, a lamp on the plate, and any number of lamps: no estimate is far out") {
  INFO("seed 41");
  radiosity::Random random{41, 0};
  for (int k = 0; k < 12; ++k) {
    Scene scene = plate_under_lamps(1.0);
    scene.materials.push_back({"dim", Color{0.0}, Color{1e-3 * random.uniform()}});
    const double side = std::pow(10.0, -3.0 * random.uniform());
    scene.objects.push_back(scenes::plate("wall", {{-1, -1, 0}, {-1, 1, 0}, {-1, 1, 0.4}, {-1, -1, 0.4}}, 2));  // touches the plate
    scene.objects.push_back(scenes::square("speck", {0, 0, 0.8}, side * 0.2, false, 1));
    for (int i = 0; i < k; ++i) { scene.objects.push_back(scenes::square("more", {0.1 * i - 0.6, 0.7, 0.6}, 0.02, false, 1)); }
    const glm::dvec3 x{1.6 * random.uniform() - 0.8, 1.2 * random.uniform() - 0.9, 0};
    double expected = 0.0;
    for (std::size_t o = 1; o < scene.objects.size(); ++o) {
      const auto outline = scene.objects[o].shape->outline();
      const radiosity::Polygon corners(outline.begin(), outline.end());
      expected += 0.5 * scene.materials[scene.objects[o].material[0]].emission.x * radiosity::point_to_polygon(x, {0, 0, 1}, corners);
    }
    const PathTraced result = path_traced(scene, x, 4000, 51);
    CAPTURE(k, side, expected, result.mean, result.error, result.largest);
    CHECK(std::abs(result.mean - expected) < 4.5 * result.error + 1e-9 * expected);
    CHECK(result.error < 0.08 * expected);
    CHECK(result.largest <= 1.0);  // rho E of both ways together: two samples of at most one half
  }
}
