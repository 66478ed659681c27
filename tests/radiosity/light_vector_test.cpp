// SPDX-License-Identifier: MIT
// The light of bodies of many facets over regions that are far from them.
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/light_vector.hpp>

#include "catch.hpp"
#include "seed.hpp"

namespace {

struct Numbers {
  std::mt19937 random;
  double operator()(double from, double to) { return std::uniform_real_distribution(from, to)(random); }
  glm::dvec3 direction() {
    const double z = (*this)(-1.0, 1.0), turn = (*this)(0.0, 6.283185307179586);
    return {std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z};
  }
};

radiosity::Facets one_part(const std::shared_ptr<const raycast::Object>& shape, double tolerance) {
  radiosity::Facets facets;
  append(facets, radiosity::facets_of(raycast::PlacedObject{shape}, tolerance));
  return facets;
}

}  // namespace

TEST_CASE("light vectors: where they are taken to be linear they are those by the outline", "[direct]") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  Numbers number{std::mt19937{seed}};
  std::vector<char> facing;
  std::size_t linear = 0;
  for (int run = 0; run < 300; ++run) {
    const glm::dvec3 axis = number.direction();
    std::shared_ptr<const raycast::Object> shape = raycast::Sphere::make({}, 1.0).object;
    if (run % 3 == 1) { shape = raycast::Torus::make({}, axis, 0.9, number(0.05, 0.3)).object; }
    if (run % 3 == 2) { shape = raycast::Cylinder::make(-0.9 * axis, 1.8 * axis, number(0.05, 0.5)).object; }
    const radiosity::Facets body = one_part(shape, 0.004);
    const glm::dvec3 centre = number(2.0, 60.0) * number.direction(), normal = run % 2 == 0 ? glm::dvec3{0.0} : number.direction();
    const double radius = number(0.05, 1.5);
    const radiosity::PointRegion region{centre, radius, normal};
    const radiosity::PossibleOutline outline{body, body.parts[0], region};
    const auto light = radiosity::LinearLightVector::fit(body.parts[0], outline, region, 1e-9, facing);
    linear += light ? 1 : 0;
    for (int k = 0; k < 20 && light; ++k) {
      const glm::dvec3 out = number.direction();
      const glm::dvec3 along = region.planar() ? glm::normalize(out - glm::dot(out, normal) * normal) : out;
      const glm::dvec3 x = centre + radius * std::sqrt(number(0.0, 1.0)) * along;
      const glm::dvec3 exact = outline.light_vector(x, 1e-9, facing);
      CAPTURE(run, radius, glm::length(centre));
      CHECK(glm::length(light->at(x) - exact) <= 4e-3 * glm::length(exact));  // as facets are off the body: 0.004 of 1
    }
  }
  CHECK(linear > 100);
}

TEST_CASE("light vectors: a sphere of facets is round, and nothing else is", "[direct]") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  Numbers number{std::mt19937{seed}};
  std::vector<char> facing;
  for (int run = 0; run < 10; ++run) {
    const double r = number(0.01, 10.0);
    const glm::dvec3 centre = 5.0 * number.direction();
    const radiosity::Facets ball = one_part(raycast::Sphere::make(centre, r).object, 0.004 * r);
    const double r2 = roundness(ball, ball.parts[0]);
    CHECK(r2 == test::Approx(r * r).epsilon(0.01));  // facets cut its corners
    const glm::dvec3 x = centre + r * number(1.2, 50.0) * number.direction(), d = centre - x;
    const glm::dvec3 exact = radiosity::PossibleOutline{ball, ball.parts[0], {x}}.light_vector(x, 0.0, facing);
    CHECK(glm::length(r2 * d / std::pow(glm::length(d), 3.0) - exact) <= 4e-3 * glm::length(exact));

    const radiosity::Facets ring = one_part(raycast::Torus::make(centre, number.direction(), r, 0.3 * r).object, 0.004 * r);
    CHECK(roundness(ring, ring.parts[0]) == 0.0);
    const radiosity::Facets can = one_part(raycast::Cylinder::make(centre, r * number.direction(), 0.5 * r).object, 0.004 * r);
    CHECK(roundness(can, can.parts[0]) == 0.0);
  }
}
