// SPDX-License-Identifier: MIT
// Pinched superquadrics beside the edges of their blades: the nearest point, and new vertices of meshes.

#include "primitives.hpp"

#include <cmath>

using namespace raycast;
using namespace test;

TEST_CASE("beside the edge of a blade, project finds a point as near as the one from which the given one was moved away") {
  SEEDED(random);
  for (int i = 0; i < 2000; ++i) {
    const double around = random.uniform(2.2, 4.0);
    const auto star = Superquadric::make({0, 0, 0}, {1, 1, 1}, random.uniform(0.5, 2.0), around);
    REQUIRE(star);
    const double t = std::pow(10.0, random.uniform(-2.0, -0.5));
    const dvec3 on{std::pow(std::cos(t), around), std::pow(std::sin(t), around), 0.0};
    const double away = std::pow(10.0, random.uniform(-6.0, -3.0));
    const dvec3 p = on + away * random.direction();
    const SurfacePoint found = star.object->project(0, p);
    INFO(i << " around " << around << " t " << t << " away " << away);
    CHECK(glm::length(found.position - p) <= away * (1.0 + 1e-6) + 1e-12);
  }
}

TEST_CASE("a new vertex between two on the edge of a blade lies on that edge, however the solid is placed") {
  SEEDED(random);
  for (int i = 0; i < 200; ++i) {
    const double around = random.uniform(2.2, 4.0), profile = random.uniform(0.5, 1.5);
    const Placement placement{random.rotation() * 3.0, 5.0 * random.in_cube(), false};
    const PlacedObject star = placed(Superquadric::make({0, 0, 0}, {1, 1, 1}, profile, around), placement);
    const auto edge = [&](double t) {  // in y = 0
      return dvec3{std::pow(std::cos(t), profile), 0.0, std::pow(std::sin(t), profile)};
    };
    const auto world = [&](const dvec3& p) { return placement.linear * p + placement.translation; };
    const double from = random.uniform(0.05, 1.0), to = from + random.uniform(0.05, 0.4);
    const dvec3 local =
        glm::inverse(placement.linear) * (star.vertex(0, 0.5 * (world(edge(from)) + world(edge(to)))) - placement.translation);
    INFO(i << " around " << around << " profile " << profile);
    CHECK(std::abs(local.y) <= 1e-13);
    CHECK(std::pow(local.x, 2.0 / profile) + std::pow(local.z, 2.0 / profile) == test::Approx(1.0).epsilon(1e-12));
  }
}
