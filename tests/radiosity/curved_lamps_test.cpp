// SPDX-License-Identifier: MIT

// Curved lamps of any kind, concave ones and thin ones too, light a point as many rays to them, or many points on them, say.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
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
#include "lit_world.hpp"
#include "scenes.hpp"
#include "seed.hpp"

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
  const std::uint64_t seed = test::seed();
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

namespace {

// A torus about `axis`, or a cylinder along it, of this radius; and the form factor from x to what faces it, by many points.
struct ThinLamp {
  bool ring = false;
  glm::dvec3 axis{0.0, 0.0, 1.0};
  double size = 0.3, radius = 0.01;  // half the length, or the radius of the ring; that of the tube
  static constexpr glm::dvec3 centre{0.0, 0.0, 0.8};

  [[nodiscard]] std::shared_ptr<const raycast::Object> shape() const {
    if (ring) { return raycast::Torus::make(centre, axis, size, radius).object; }
    return raycast::Cylinder::make(centre - size * axis, 2.0 * size * axis, radius).object;
  }
  [[nodiscard]] double form_factor(const glm::dvec3& x) const {
    const auto [u, v] = radiosity::orthonormal(axis);
    constexpr int along = 2000, around = 200;
    double sum = 0.0;
    const auto add = [&](const glm::dvec3& p, const glm::dvec3& n, double area) {
      const glm::dvec3 d = p - x;
      const double r2 = glm::dot(d, d);
      sum += std::max(0.0, d.z) * std::max(0.0, -glm::dot(n, d)) * area / (M_PI * r2 * r2);
    };
    for (int i = 0; i < along; ++i) {
      const double part = (i + 0.5) / along, turn = 2 * M_PI * part;
      const glm::dvec3 out = std::cos(turn) * u + std::sin(turn) * v;
      const glm::dvec3 middle = centre + (ring ? size * out : size * (2 * part - 1) * axis);
      for (int j = 0; j < around; ++j) {
        const double angle = 2 * M_PI * (j + 0.5) / around, c = std::cos(angle), s = std::sin(angle);
        const glm::dvec3 n = ring ? c * out + s * axis : c * u + s * v;
        const double length = ring ? 2 * M_PI * (size + radius * c) : 2 * size;
        add(middle + radius * n, n, length / along * (2 * M_PI * radius / around));
      }
    }
    for (const double end : {-size, size}) {
      if (!ring) { add(centre + end * axis, end < 0 ? -axis : axis, M_PI * radius * radius); }
    }
    return sum;
  }
};

}  // namespace

// Facets have the area of the lamp within .3 %, so the width of its outline may be off by three times that at most, as it turns; eight
// around a tube, whatever its radius, would be off by up to 8 %.
TEST_CASE("direct light: a tube or a ring, however thin, is as bright from all around", "[direct]") {
  const std::uint64_t seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0, 0};
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  for (int i = 0; i < 12; ++i) {
    ThinLamp lamp;
    lamp.ring = i % 2 == 0;
    lamp.axis = glm::normalize(glm::dvec3{between(-1, 1), between(-1, 1), between(-1, 1)});
    lamp.radius = std::pow(10.0, between(lamp.ring ? -2.0 : -3.0, -1.5));  // of a thinner ring the facets would be too many
    radiosity::Scene scene = scenes::floor_under_lamp(0.4);
    scene.objects[1] = scenes::object("lamp", lamp.shape(), 1);
    const scenes::World world{scene};
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 x{between(-0.9, 0.9), between(-0.9, 0.9), 0.0};
      auto region = world.region(x, 0.01);
      double found = 0.0;
      for (std::size_t part = 0; part < region.size(); ++part) { found += region.unhidden(part, world.in_frame(x), {0, 0, 1}); }
      const double exact = lamp.form_factor(x);
      CAPTURE(i, k, lamp.ring, lamp.radius, lamp.axis.x, lamp.axis.y, lamp.axis.z, x.x, x.y, found, exact);
      CHECK(std::abs(found - exact) <= 0.01 * exact);
    }
  }
}
