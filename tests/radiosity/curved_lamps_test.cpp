// SPDX-License-Identifier: MIT

// Curved lamps of any kind, concave ones too, light a point as many rays to them say.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <raycast/objects/cone.hpp>
#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"

namespace {

constexpr int kinds = 8;

// A lamp of about the size 0.3 about the origin.
std::shared_ptr<const raycast::Object> lamp_shape(int kind, radiosity::Random& random) {
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const auto sphere = [&](double x, double radius) { return raycast::Sphere::make({x, 0, 0}, radius).object; };
  switch (kind) {
    case 0:
      return sphere(0.0, 0.3);
    case 1:
      return raycast::Cylinder::make({0, 0, -0.2}, {0, 0, 0.4}, between(0.05, 0.3)).object;
    case 2:
      return raycast::Cone::make({0, 0, -0.2}, {0, 0, 0.4}, 0.3, between(0.0, 0.2)).object;
    case 3:
      return raycast::Torus::make({0, 0, 0}, {0, 0, 1}, 0.25, between(0.03, 0.12)).object;
    case 4:
      return raycast::Superquadric::make({0, 0, 0}, {0.3, 0.25, 0.2}, between(0.3, 2.0), between(0.3, 2.0)).object;
    case 5:
      return raycast::Superquadric::make({0, 0, 0}, {0.3, 0.3, 0.3}, between(0.5, 3.0), between(2.0, 3.5)).object;
    case 6:
      return raycast::Superquadric::make({0, 0, 0}, {0.1, 0.1, 0.1}, between(0.4, 1.6), between(0.4, 1.6), 2.0).object;
    default: {
      raycast::CsgNode bowl{{}, "bowl", raycast::CsgOperation::subtract, {}, {}};
      bowl.parts.push_back({sphere(0.0, 0.3), "outer", {}, {}, {}});
      bowl.parts.push_back({sphere(between(0.1, 0.3), 0.25), "inner", {}, {}, {}});
      return raycast::Csg::make(bowl).object;
    }
  }
}

}  // namespace

// A lamp over a floor, with a sphere beside it that may hide a part. What is hidden of a curved lamp is known by the share of 256 points on
// it, each of them with the same area: a part in thirty is what these may miss where an outline runs through them, and where the first 64
// agree. A lamp whose own surface hides the points on it lost between a third and all of its light.
TEST_CASE("direct light: a curved lamp of any kind lights points as many rays to it say", "[direct]") {
  const std::uint64_t seed = std::random_device{}();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0, 0};
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  for (int i = 0; i < 3 * kinds; ++i) {
    radiosity::Scene scene{
        {{"white", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.5}, radiosity::Color{1.0}}}, {}};
    scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true), scenes::object("lamp", lamp_shape(i % kinds, random), 1),
                     scenes::object("ball", raycast::Sphere::make({between(-1, 1), between(-1, 1), 0.3}, 0.2).object)};
    REQUIRE(scene.objects[1].shape);
    const glm::dvec3 axis = glm::normalize(glm::dvec3{between(-1, 1), between(-1, 1), between(-1, 1)});
    scene.objects[1].placement.linear = glm::dmat3(glm::rotate(glm::dmat4(1.0), between(0, 6), axis));
    scene.objects[1].placement.translation = {between(-0.4, 0.4), between(-0.4, 0.4), between(0.5, 0.9)};
    auto prepared = std::move(*radiosity::prepare(scene).prepared);
    std::vector<radiosity::Color> emission;
    for (const radiosity::InputSurface& s : radiosity::surfaces(scene)) { emission.push_back(scene.materials[s.material].emission); }
    const radiosity::DirectLight light{prepared.objects, prepared.surfaces, emission, {64, 1.0}};
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 x = (glm::dvec3{between(-0.9, 0.9), between(-0.9, 0.9), 0.0} - prepared.frame.centre) * prepared.frame.scale;
      const glm::dvec3 n{0, 0, 1};
      if (prepared.objects.covered(x, n, 0)) { continue; }
      const std::array<glm::dvec3, 4> contour{x, x, x, x};
      radiosity::LitRegion region{light, {contour, 0, 0.0}, n};
      const double found = region.irradiance(x, n).x;
      double open = 0.0;
      for (std::size_t lamp = 0; lamp < region.size(); ++lamp) { open += region.unhidden(lamp, x, n); }
      constexpr std::uint32_t rays = 2048;
      const radiosity::Sobol4 sequence{seed, static_cast<std::uint64_t>(4 * i + k)};
      double met = 0.0;
      for (std::uint32_t r = 0; r < rays; ++r) {
        const auto u = sequence(r);
        const auto hit = prepared.objects.closest({x, prepared.objects.diameter() * radiosity::cosine_direction(n, u[0], u[1])}, 0);
        met += hit && hit->object == 1 ? 1.0 / rays : 0.0;
      }
      CAPTURE(i, k, x.x, x.y, found, met, open);
      // Even rays that cross an outline are far less noisy than random ones: 4 standard errors of those are more than 4 of these.
      CHECK(std::abs(found - met) <= 4.0 * std::sqrt(std::max(met, 1.0 / rays) / rays) + open / 30.0);
    }
  }
}
