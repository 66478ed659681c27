// SPDX-License-Identifier: MIT

// Long faces are cut across before refinement: into parts of good proportion, and into no more than the run is fine.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/validate.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/long_faces.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"

namespace {

// Extent of a rectangle along its longest side over that across.
double proportion(const radiosity::Polygon& corners, double area) {
  double longest = 0.0;  // the diagonal
  for (const glm::dvec3& a : corners) {
    for (const glm::dvec3& b : corners) { longest = std::max(longest, glm::length(b - a)); }
  }
  const double square = longest * longest;  // l^2 + w^2, with l w = area
  const double length = std::sqrt(0.5 * (square + std::sqrt(std::max(0.0, square * square - 4.0 * area * area))));
  return length * length / area;
}

}  // namespace

TEST_CASE("long faces: parts are at most twice as long as wide, and as many as the run is fine, over rooms of 10 : 1 to 100 000 : 1") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  radiosity::Random random{seed, 0};
  for (int i = 0; i < 20; ++i) {
    const double length = std::pow(10.0, 1.0 + 4.0 * random.uniform()), min_area = std::pow(10.0, -2.0 - 2.0 * random.uniform());
    const int axis = i % 3;
    glm::dvec3 size{0.5 + random.uniform(), 0.5 + random.uniform(), 0.5 + random.uniform()};
    size[axis] = length;
    CAPTURE(i, length, min_area);
    radiosity::Scene scene;
    scene.materials = {{"wall", radiosity::Color{0.5}, radiosity::Color{0.1}}};
    scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, size), 0, true)};
    radiosity::PrepareResult made = radiosity::prepare(scene);
    REQUIRE(made.prepared);
    std::vector<radiosity::Surface>& surfaces = made.prepared->surfaces;
    radiosity::cut_long_faces(surfaces, min_area);
    const radiosity::SurfaceBRep& brep = surfaces.front().brep;
    CHECK(brep::validate(brep).empty());
    std::vector<double> areas, proportions;
    double all = 0.0;
    for (const brep::FaceId f : brep::faces(brep)) {
      const glm::dvec3 up = brep::vector_area(brep, f);
      all += glm::length(up);
      if (std::abs(up[axis]) > 0.5 * glm::length(up)) { continue; }  // one of the two ends
      areas.push_back(glm::length(up));
      proportions.push_back(proportion(radiosity::corner_polygon(brep, f), areas.back()));
    }
    // What is cut is larger than four times min_area, so each part has at least half of that.
    CHECK(static_cast<double>(areas.size()) <= 0.5 / min_area + 4.0);
    // Walls are at most 1.5 wide, so of a length above 12 all of them are longer than 8 : 1.
    for (std::size_t k = 0; k < areas.size() && length > 12.0; ++k) {
      CAPTURE(areas[k] / all);
      if (areas[k] > 4.0 * min_area * all) { CHECK(proportions[k] <= 2.0 * (1.0 + 1e-9)); }
    }
  }
}
