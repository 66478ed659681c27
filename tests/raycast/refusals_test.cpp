// SPDX-License-Identifier: MIT
// What is refused, with which words; and how placements compose.

#include "primitives.hpp"

#include <limits>
#include <string>

using namespace raycast;
using namespace test;

TEST_CASE("factories refuse with a sentence what is no object") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const auto& made, const std::string& part) {
    INFO(made.refusal);
    CHECK_FALSE(made);
    CHECK(made.refusal.find(part) != std::string::npos);
  };
  refused(Polygon::make({}), "0 corners");
  refused(Polygon::make({{0, 0, 0}, {1, 0, 0}}), "2 corners");
  refused(Polygon::make({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}), "number 3");
  refused(Polygon::make({{0, 0, 0}, {infinity, 0, 0}, {0, 1, 0}}), "not finite");
  refused(Polygon::make({{0, 0, 0}, {1e200, 0, 0}, {0, 1, 0}}), "not finite");
  refused(Polygon::make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), "no area");
  refused(Polygon::make({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), "no size");
  refused(Polygon::make({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "equal corners");
  refused(Polygon::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.01}, {0, 1, 0}}), "not planar");
  refused(Polygon::make({{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {2, 2, 0}}), "intersects itself");
  refused(Polygon::make({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}}), "intersects itself");  // a corner on another edge
  refused(Polygon::make({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 2, 0}}), "turns back");
  CHECK(Polygon::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-7}, {0, 1, 0}}));  // within 1e-6
  refused(BoxObject::make({0, 0, 0}, {1, 0, 1}), "along y");
  refused(BoxObject::make({0, 0, 2}, {1, 1, 1}), "along z");
  refused(BoxObject::make({0, 0, nan}, {1, 1, 1}), "finite");
  refused(BoxObject::make({1e20, 0, 0}, {1e20 + 1e6, 1, 1}), "along x");
  refused(Sphere::make({0, 0, 0}, 0.0), "radius");
  refused(Sphere::make({0, 0, 0}, -1.0), "radius");
  refused(Sphere::make({0, 0, 0}, nan), "radius");
  refused(Sphere::make({nan, 0, 0}, 1.0), "centre");
  refused(Cylinder::make({0, 0, 0}, {0, 0, 0}, 1.0), "axis");
  refused(Cylinder::make({0, 0, 0}, {0, 0, 1}, 0.0), "radius");
  refused(Cylinder::make({0, 0, 0}, {0, infinity, 1}, 1.0), "finite");
  const dvec3 o{0, 0, 0}, z{0, 0, 1};
  refused(Disk::make({nan, 0, 0}, z, 1.0), "finite");
  refused(Disk::make(o, o, 1.0), "normal");
  refused(Disk::make(o, z, -1.0), "radius");
  refused(Disk::make({1e20, 0, 0}, z, 1.0), "vanishing");
  refused(Cone::make(o, o, 1.0), "axis");
  refused(Cone::make(o, z, 0.0, 1.0), "base radius");
  refused(Cone::make(o, z, 1.0, -0.5), "top radius");
  refused(Cone::make(o, z, nan), "base radius");
  refused(Torus::make(o, o, 1.0, 0.5), "axis");
  refused(Torus::make(o, z, 1.0, 1.0), "passes through itself");
  refused(Torus::make(o, z, 1.0, nan), "radii");
  refused(Torus::make(o, z, 1.0, 1e-5), "1e-4");
  refused(Superquadric::make(o, {1, 1, 0}, 1, 1), "radii");
  refused(Superquadric::make(o, {1, 1, 1e-7}, 1, 1), "radii");
  refused(Superquadric::make(o, {1, 1, 1}, 0, 1), "exponents");
  refused(Superquadric::make(o, {1, 1, 1}, 1, nan), "exponents");
  refused(Superquadric::make(o, {1, 1, 1}, 1, 1, 1.0), "ring");
  refused(Superquadric::make(o, {1, 1, 1}, 1, 1, nan), "ring");
  refused(Instance::make(nullptr, {}), "needs an object");
  refused(Instance::make(Sphere::make(o, 1.0).object, room()), "inside out");
  refused(Instance::make(Sphere::make(o, 1.0).object, {glm::dmat3(0.0), o, false}), "flattens");
  refused(Mesh::make({}, {}), "no faces");
  refused(Mesh::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}), "face 0 names vertex 3");
  refused(Mesh::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1}}), "face 0");
  refused(Mesh::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 2, 3}}), "manifold");  // opposite orientations
  refused(Mesh::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}), "manifold");
  refused(Mesh::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}), "inside out");

  Placement placement;
  CHECK_FALSE(check(placement));
  placement.linear = glm::dmat3(1, 0, 0, 0, 1, 0, 1, 1, 0);
  CHECK(check(placement)->find("flattens") != std::string::npos);
  placement.linear = glm::dmat3(0.0);
  CHECK(check(placement));
  placement.linear = glm::dmat3(1e-6);  // small is not singular
  CHECK_FALSE(check(placement));
  placement.translation.y = nan;
  CHECK(check(placement)->find("not finite") != std::string::npos);
  placement = room();
  CHECK(check(*Polygon::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), placement)->find("inside out") != std::string::npos);
}

TEST_CASE("placements compose, and the stretch of a map is its largest singular value") {
  SEEDED(random);
  for (int i = 0; i < 1000; ++i) {
    const Placement a{random.rotation() * 2.0, random.in_cube(), true}, b{random.rotation(), random.in_cube(), i % 2 == 0};
    const Placement both = compose(a, b);
    const dvec3 p = random.in_cube();
    CHECK(glm::length((both.linear * p + both.translation) - (a.linear * (b.linear * p + b.translation) + a.translation)) < 1e-14);
    CHECK(both.inside == (i % 2 != 0));
    const double s[3] = {random.magnitude(6), random.magnitude(6), random.magnitude(6)};
    const glm::dmat3 map = random.rotation() * glm::dmat3(s[0], 0, 0, 0, s[1], 0, 0, 0, s[2]) * random.rotation();
    const double largest = std::max({s[0], s[1], s[2]});
    CHECK(stretch(map) >= largest * (1 - 1e-12));
    CHECK(stretch(map) <= largest * 1.002);
  }
}
