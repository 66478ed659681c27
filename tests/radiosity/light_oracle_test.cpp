// SPDX-License-Identifier: MIT

// What the light of a lamp does: the light oracle keeps its variation over a leaf small, and the path tracer tells it from the rest.

#include <algorithm>
#include <cmath>
#include <vector>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <raycast/objects/sphere.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

// A square lamp about the point (x, y, z) of unit emission, seen from above or from below.
radiosity::Polygon lamp_square(const glm::dvec3& centre, double side, bool up) {
  const double h = 0.5 * side;
  radiosity::Polygon corners;
  for (const glm::dvec2 c : {glm::dvec2{-h, -h}, glm::dvec2{h, -h}, glm::dvec2{h, h}, glm::dvec2{-h, h}}) {
    corners.push_back(centre + glm::dvec3{c, 0.0});
  }
  if (!up) { std::reverse(corners.begin(), corners.end()); }
  return corners;
}

}  // namespace

TEST_CASE("light oracle: over a leaf of a sphere the light of a lamp varies by no more than its share of the error") {
  const radiosity::Polygon lamp = lamp_square({0, 0, 3}, 0.2, false);
  radiosity::Scene scene;
  scene.materials = {{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  scene.objects = {scenes::object("ball", raycast::Sphere::make({0, 0, 0}, 0.5).object, 0),
                   scenes::object("lamp", scenes::polygon(lamp), 1)};
  radiosity::Options options;
  options.audit_points = 0;
  options.epsilon = 0.5;
  options.min_area = 1e-4;  // the lamp is far: nothing but its light splits anything
  options.light_epsilon = 0.0003;
  const radiosity::Solution solution = scenes::solved(scene, options);
  double scene_area = 0.0;
  double power = 0.0;
  for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
    const radiosity::Node& node = solution.hierarchy[i];
    if (!radiosity::is_input_face(solution.hierarchy, i)) { continue; }
    scene_area += node.area;
    power += node.surface == 1 ? node.area : 0.0;
  }
  std::size_t leaves = 0;
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    if (face.surface != 0) { continue; }
    double low = 1.0;
    double high = 0.0;
    for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
      const glm::dvec3& x = solution.mesh.positions[solution.mesh.corners[c].vertex];
      const double f = radiosity::point_to_polygon(x, glm::normalize(x), lamp);
      low = std::min(low, f);
      high = std::max(high, f);
    }
    const double weight = scene_area / power * std::sqrt(solution.hierarchy[face.node].area / scene_area);
    // Linear between extremes; the disk of the oracle's estimate errs by (.1 / 2.5)^2, the lamp's half side over the least distance.
    CHECK(weight * (high - low) <= std::sqrt(12.0) * *options.light_epsilon * (1.0 + 2.0 * 0.0016));
    ++leaves;
  }
  CHECK(leaves > 200);
}

TEST_CASE("path tracing: the light that was reflected once is rho E F, whether lamps are sampled or met by chance") {
  for (const double side : {0.2, 1.0}) {  // one lamp is a 25th of the wall, the other as large
    CAPTURE(side);
    const radiosity::Polygon lamp = lamp_square({0, 0, 0}, side, true);
    radiosity::Scene scene;
    scene.materials = {{"lamp", radiosity::Color{0.5}, radiosity::Color{1.0}}, {"wall", radiosity::Color{0.5}, radiosity::Color{0.0}}};
    scene.objects = {scenes::object("lamp", scenes::polygon(lamp), 0),
                     scenes::object("wall", scenes::polygon(lamp_square({0, 0, 1}, 1.0, false)), 1)};
    const radiosity::PrepareResult prepared = radiosity::prepare(scene);
    REQUIRE(prepared.prepared);
    const radiosity::PathTracer tracer{scene, prepared.prepared->objects, prepared.prepared->surfaces};
    const radiosity::Frame& frame = prepared.prepared->frame;
    const glm::dvec3 x = (glm::dvec3{0, 0, 1} - frame.centre) * frame.scale;
    const int paths = 40'000;
    double sum = 0.0;
    double square = 0.0;
    double rest = 0.0;
    std::uint64_t rays = 0;
    for (int i = 0; i < paths; ++i) {
      radiosity::Random random{11, static_cast<std::uint64_t>(i)};
      const radiosity::PathTracer::Light light = tracer.radiosity(x, {0, 0, -1}, 1, 0, random, rays);
      sum += light.direct.x / paths;
      square += light.direct.x * light.direct.x / paths;
      REQUIRE(light.all.x >= light.direct.x);
      rest += light.all.x - light.direct.x;
    }
    const double expected = 0.5 * radiosity::point_to_polygon({0, 0, 1}, {0, 0, -1}, lamp);
    CHECK(std::abs(sum - expected) <= 4.0 * std::sqrt((square - sum * sum) / paths) + 1e-12);
    CHECK(rest > 0.0);
  }
}
