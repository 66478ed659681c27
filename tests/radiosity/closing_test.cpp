// SPDX-License-Identifier: MIT

// A closed scene is corrected so that all row sums are 1: what is wrong is taken out of the light between walls, not out of that of lamps.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <raycast/objects/box.hpp>
#include <raycast/objects/sphere.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

struct HungSphere {
  radiosity::Scene scene;
  glm::dvec3 centre;
  double radius, height;  // of the room
};

// A room that hardly reflects, with a spherical lamp of unit emission close below its ceiling.
HungSphere hung_sphere(radiosity::Random& random) {
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const double w = between(2.0, 5.0), d = between(2.0, 5.0), h = between(2.2, 4.0);
  const double radius = between(0.05, 0.3), gap = radius * between(0.2, 1.0);
  const double x = between(0.3, 0.7) * w, y = between(0.3, 0.7) * d;
  HungSphere hung{{}, {x, y, h - gap - radius}, radius, h};
  hung.scene.materials = {{"dark", radiosity::Color{0.001}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  hung.scene.objects = {scenes::object("room", raycast::BoxObject::make({0, 0, 0}, {w, d, h}).object, 0, true),
                        scenes::object("lamp", raycast::Sphere::make(hung.centre, radius).object, 1)};
  return hung;
}

// Relative L2 error of the leaves of the ceiling against the irradiance of a sphere, (r / d)^2 cos.
double error_on_ceiling(const HungSphere& hung, const radiosity::Solution& solution) {
  double square = 0.0;
  double norm = 0.0;
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    glm::dvec3 lo{1e9}, hi{-1e9};
    double b = 0.0;
    for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
      const radiosity::MeshCorner& corner = solution.mesh.corners[c];
      lo = glm::min(lo, solution.mesh.positions[corner.vertex]);
      hi = glm::max(hi, solution.mesh.positions[corner.vertex]);
      b += corner.radiosity.x / face.corner_count;
    }
    if (!(lo.z > hung.height - 1e-6)) { continue; }
    constexpr int n = 4;
    double mean = 0.0;
    for (int k = 0; k < n * n; ++k) {
      const glm::dvec3 p = lo + (hi - lo) * glm::dvec3{(k % n + 0.5) / n, (k / n + 0.5) / n, 0.0};
      const double away = glm::length(hung.centre - p);
      mean += hung.radius * hung.radius / (away * away) * (p.z - hung.centre.z) / away / (n * n);
    }
    const double area = solution.hierarchy[face.node].area, error = b / 0.001 - mean;
    square += area * error * error;
    norm += area * mean * mean;
  }
  return std::sqrt(square / norm);
}

}  // namespace

TEST_CASE("closing a room leaves the light of a lamp under its ceiling, which hides much of the room from it, as it is", "[accuracy]") {
  const auto seed = std::random_device{}();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0x63656960ull};
  for (int round = 0; round < 6; ++round) {
    const HungSphere hung = hung_sphere(random);
    radiosity::Options options;
    options.audit_points = 0;
    options.reconstruction = radiosity::Reconstruction::constant;  // a face a leaf
    for (const radiosity::Indirect indirect : {radiosity::Indirect::links, radiosity::Indirect::rays}) {
      options.indirect = indirect;
      const radiosity::Solution solution = scenes::solved(hung.scene, options);
      CAPTURE(round, hung.radius, hung.height - hung.centre.z, indirect == radiosity::Indirect::links);
      REQUIRE(solution.audit.closure);
      CHECK(solution.audit.row_sum.min > 1.0 - 1e-6);
      CHECK(solution.audit.row_sum.max < 1.0 + 1e-6);
      CHECK(error_on_ceiling(hung, solution) < (indirect == radiosity::Indirect::links ? 0.04 : 0.06));
    }
  }
}
