// SPDX-License-Identifier: MIT
// The form factor of bodies of many facets, by their outline.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/handles.hpp>

#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/light_vector.hpp>
#include <radiosity/direct/outline_tolerance.hpp>
#include <radiosity/geometry/form_factor.hpp>

#include "catch.hpp"
#include "seed.hpp"

TEST_CASE("the form factor of a body by its outline is the sum over its facets, above the horizon and across it") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); };
  const auto vector = [&] { return glm::dvec3(number(), number(), number()); };
  std::vector<char> facing;
  std::size_t across = 0;
  for (int run = 0; run < 400; ++run) {
    std::shared_ptr<const raycast::Object> shape = raycast::Sphere::make(glm::dvec3(0.0), 1.0).object;
    if (run % 2 == 1) { shape = raycast::Torus::make(glm::dvec3(0.0), glm::normalize(vector()), 0.8, 0.2 + 0.1 * number()).object; }
    radiosity::Facets body;
    append(body, radiosity::facets_of(raycast::PlacedObject{shape}, 0.01));
    const glm::dvec3 x = (1.2 + number() * number() + (run % 3)) * glm::normalize(vector()), n = glm::normalize(vector());
    double sum = 0.0;
    bool above = true;
    for (const radiosity::Facets::Facet& facet : body.facets) {
      for (const glm::dvec3& p : facet.contour) { above = above && glm::dot(n, p - x) >= 0.0; }
      if (!(facet.height(x) > 1e-9)) { continue; }
      radiosity::Polygon part;
      radiosity::clip_to_horizon(facet.contour, x, n, part);
      if (part.size() >= 3) { sum += radiosity::point_to_polygon(x, n, part); }
    }
    CAPTURE(run);
    CHECK(radiosity::form_factor(body, x, n, 1e-9, facing) == test::Approx(sum).margin(1e-12));
    if (above) {
      const double off = 0.2 * std::abs(number());
      const radiosity::PossibleOutline outline{body, body.parts[0], {x + off * glm::normalize(vector()), off}};
      CHECK(glm::dot(n, outline.light_vector(x, 1e-9, facing)) == test::Approx(sum).margin(1e-12));
    }
    across += !above && sum > 0.0 ? 1 : 0;
  }
  CHECK(across > 50);
}

// Along the curve in which two surfaces meet, faces have many corners that are in no plane.
TEST_CASE("the facets of an intersection of round solids are planar, each edge has two of them, and no corner lies before one") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); };
  const auto vector = [&] { return glm::dvec3(number(), number(), number()); };
  int solids = 0;
  for (int run = 0; run < 40; ++run) {
    raycast::CsgNode node{{}, "solid", raycast::CsgOperation::intersect, {}, {}};
    for (int k = 0; k < 2 + run % 2; ++k) {
      const glm::dvec3 at = 0.3 * vector(), axis = glm::normalize(vector());
      std::shared_ptr<const raycast::Object> part = raycast::Sphere::make(at, 0.8 + 0.3 * number()).object;
      if ((run + k) % 2 == 1) { part = raycast::Cylinder::make(at - axis, 2.0 * axis, 0.5 + 0.2 * number()).object; }
      node.parts.push_back({part, "part", {}, {}, {}});
    }
    const auto made = raycast::Csg::make(node);
    if (!made.object) { continue; }
    ++solids;
    const raycast::PlacedObject object{made.object};
    const double tolerance = 0.0004 * object.bounds().diameter();
    const radiosity::Facets facets = radiosity::facets_of(object, tolerance);
    CAPTURE(run);
    double out_of_plane = 0.0, before = 0.0;
    for (const radiosity::Facets::Facet& facet : facets.facets) {
      double length = 0.0;
      for (std::size_t i = 0; i < facet.contour.size(); ++i) {
        out_of_plane = std::max(out_of_plane, std::abs(facet.height(facet.contour[i])));
        length = std::max(length, glm::length(facet.contour[i] - facet.contour[(i + 1) % facet.contour.size()]));
      }
      // Corners may be off the surface by the tolerance, by which a narrow facet is turned.
      const double off = tolerance * (1.0 + object.bounds().diameter() * length / facet.area);
      for (const radiosity::Facets::Facet& other : facets.facets) { before = std::max(before, facet.height(other.contour[0]) / off); }
    }
    CHECK(out_of_plane < 1e-9);
    CHECK(before < 2.0);
    for (const radiosity::Facets::Edge& edge : facets.edges) { REQUIRE(edge.right != brep::invalid_index); }
  }
  CHECK(solids > 30);
}

// The rim of a lens of two equal spheres is a circle; its chords are the farther off it the thinner the lens.
TEST_CASE("the outline of a lens is as near to its rim as to its surfaces, however thin the lens", "[accuracy]") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int run = 0; run < 12; ++run) {
    const double radius = 0.5, sphere = radius * (1.0 + 5.0 * std::generate_canonical<double, 32>(random));
    const double up = std::sqrt(sphere * sphere - radius * radius);
    raycast::CsgNode lens{{}, "lens", raycast::CsgOperation::intersect, {}, {}};
    for (const double side : {up, -up}) { lens.parts.push_back({raycast::Sphere::make({0, 0, side}, sphere).object, "side", {}, {}, {}}); }
    const auto made = raycast::Csg::make(lens);
    REQUIRE(made.object);
    const raycast::PlacedObject object{made.object};
    constexpr double part = 0.002;
    const radiosity::Facets facets = radiosity::facets_of(object, radiosity::outline_tolerance(object, part));
    int rim = 0;
    double off = 0.0;
    for (const radiosity::Facets::Edge& edge : facets.edges) {
      const auto on_rim = [&](const glm::dvec3& p) { return std::abs(p.z) < 1e-6 && std::abs(glm::length(p) - radius) < 1e-6; };
      if (!on_rim(edge.a) || !on_rim(edge.b)) { continue; }
      ++rim;
      off = std::max(off, radius - glm::length(0.5 * (edge.a + edge.b)));
    }
    CAPTURE(run, sphere, rim, off);
    CHECK(rim > 20);
    CHECK(off < 2.0 * part * 2.0 * radius);
  }
}
