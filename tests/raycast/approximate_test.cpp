// SPDX-License-Identifier: MIT
// The approximation (the paper's approxShape): closed, oriented, on the surface, within the tolerance.

#include "primitives.hpp"

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/polygon.hpp>

using namespace raycast;
using namespace test;

namespace {

struct Position {
  dvec3 position{0.0};
};
struct Sheet {
  std::uint32_t sheet = 0;
};
using Shell = brep::BRep<Position, brep::NoData, Sheet>;

std::vector<std::pair<std::string, Made<Object>>> shapes() {
  std::vector<std::pair<std::string, Made<Object>>> all{
      {"sphere", Sphere::make({1, 2, 3}, 0.5)},
      {"box", BoxObject::make({-1, 0, 2}, {1, 3, 2.5})},
      {"cylinder", Cylinder::make({1, 0, 0}, {0.3, -0.2, 2}, 0.5)},
      {"flat cylinder", Cylinder::make({0, 0, 0}, {0, 0, 0.01}, 2)},
      {"polygon", Polygon::make({{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {1, 0.5, 1}})},
      {"solid mesh", l_block()},
      {"open mesh", Mesh::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}}, {{0, 1, 2, 3}, {1, 0, 4, 5}})},
      {"disk", Disk::make({1, 0, 2}, {0.3, -0.2, 2}, 0.5)}};
  for (const Primitive& primitive : primitives()) { all.push_back({primitive.name, primitive.make({1, -1, 2}, 1.5)}); }
  return all;
}
bool ring(const std::string& name) {
  return name.find("ring") != std::string::npos || name.find("torus") != std::string::npos || name == "supertorus";
}

}  // namespace

TEST_CASE("an approximation closes without defects, lies on the surface, and its chords keep the tolerance") {
  SEEDED(random);
  const Placement placements[] = {{},
                                  {random.rotation() * 3.0, {5, 6, 7}, false},
                                  {glm::dmat3(-1, 0, 0, 0, 2, 0, 0, 0.5, 1), {0, 0, 1}, false},
                                  room(),
                                  room(glm::dmat3(1, 0, 0, 0, 0, 1, 0, 1, 0))};
  for (const auto& [name, shape] : shapes()) {
    for (const Placement& placement : placements) {
      for (const double tolerance : {1.0, 0.05, 0.002}) {
        if (placement.inside && !shape->solid()) { continue; }
        if (tolerance < 0.01 && name != "sphere" && placement.linear != glm::dmat3(1.0)) continue;  // thousands of faces each
        INFO(name << " tolerance " << tolerance << " inside " << placement.inside << " determinant " << glm::determinant(placement.linear));
        const PlacedObject object = placed(shape, placement);
        brep::Builder builder;
        object.approximate(tolerance, builder);
        const auto result = brep::close<Shell>(builder);
        for (const auto& defect : result.defects) { FAIL_CHECK(defect.sentence); }
        REQUIRE(result.brep);
        const Shell& shell = *result.brep;
        CHECK(brep::genus(shell) == (ring(name) ? 1 : 0));
        const bool blades = name == "needles" || name.find("star") != std::string::npos;
        dvec3 total{0.0};
        double farthest = 0.0, wrong_side = 0.0, size = object.bounds().diameter();
        for (const brep::FaceId f : brep::faces(shell)) {
          total += brep::vector_area(shell, f);
          const std::uint32_t sheet = shell.data(f).sheet;
          if (sheet == brep::no_sheet) {
            CHECK_FALSE(object.solid());
            continue;
          }
          REQUIRE(sheet < object.sheet_count());
          const auto corners = brep::positions(shell, f);
          const dvec3 normal = brep::normal(brep::Polygon(corners)), middle = brep::centroid(brep::Polygon(corners));
          for (const dvec3& p : corners) {
            CHECK(glm::length(object.project(sheet, p).position - p) <= 1e-14 * (size + object.bounds().magnitude()));
          }
          // Counter-clockwise from the air. Quadrilaterals of a coarse cube sphere tilt by up to 45 degrees.
          wrong_side = std::min(wrong_side, glm::dot(normal, object.project(sheet, middle).normal));
          for (std::size_t i = 2; i < corners.size(); ++i) {
            for (int k = 0; k < (tolerance < 0.01 ? 2 : 8); ++k) {
              double a = random.uniform(), b = random.uniform();
              if (a + b > 1) { a = 1 - a, b = 1 - b; }
              const dvec3 p = corners[0] + a * (corners[i - 1] - corners[0]) + b * (corners[i] - corners[0]);
              farthest = std::max(farthest, glm::length(object.project(sheet, p).position - p));
            }
          }
        }
        if (!blades) CHECK(wrong_side >= 0.0);  // a blade's chord may be nearest to its other side
        CHECK(glm::length(total) <= 1e-11 * size * size);
        if (object.exact()) {
          CHECK(farthest <= 1e-13 * (size + object.bounds().magnitude()));
        } else {
          // The point nearest under the map's own projection is no nearer than the nearest one, so allow the map's condition number.
          // Between blades project finds the nearest point of one blade only; the test below measures these.
          CHECK(farthest <= tolerance * (placement.identity() || placement.inside ? 1.0 : 3.0) * (blades ? 3.0 : 1.0));
        }
      }
    }
  }
}

TEST_CASE("chords of pinched superquadrics keep the tolerance, measured against a dense sample of their surface") {
  SEEDED(random);
  for (const auto& [profile, around] : {std::pair(6.0, 8.0), std::pair(3.0, 3.0), std::pair(1.0, 3.0)}) {
    const auto object = Superquadric::make({0, 0, 0}, {1, 1, 1}, profile, around);
    constexpr int side = 200;  // Barr's angles over one octant
    Corners surface;
    for (int i = 0; i <= side; ++i) {
      for (int j = 0; j <= side; ++j) {
        const double a = 1.57079632679 * i / side, b = 1.57079632679 * j / side, g = std::pow(std::cos(b), profile);
        surface.push_back(
            {g * std::pow(std::cos(a), around), g * std::pow(std::abs(std::sin(a)), around), std::pow(std::abs(std::sin(b)), profile)});
      }
    }
    brep::Builder builder;
    object->approximate(0.03, builder);
    double farthest = 0.0;
    for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
      const auto c = builder.corners(f);
      const double a = random.uniform(), b = random.uniform(0, 1 - a);
      const dvec3 p = glm::abs((1 - a - b) * builder.position(c[0]) + a * builder.position(c[1]) + b * builder.position(c[2]));
      double squared = infinity;
      for (const dvec3& q : surface) { squared = std::min(squared, glm::dot(p - q, p - q)); }
      farthest = std::max(farthest, std::sqrt(squared));
    }
    CHECK(farthest <= 0.03 + 0.01);  // the slope of the sampled curves is at most 1.8: a sample lies within 0.01
    CHECK(farthest > 0.001);
  }
}

TEST_CASE("a cylinder is cut in a multiple of four columns, its caps are single faces that share the rims") {
  for (const double tolerance : {10.0, 0.1, 0.01, 1e-4}) {
    brep::Builder builder;
    Cylinder::make({0, 0, 0}, {0, 0, 2}, 1)->approximate(tolerance, builder);
    std::size_t side = 0, bottom = 0, top = 0, columns = 0;
    for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
      if (builder.sheet(f) == 0) { ++side; }
      if (builder.sheet(f) == 1) { ++bottom, columns = builder.corners(f).size(); }
      if (builder.sheet(f) == 2) { ++top; }
    }
    CHECK(bottom == 1);
    CHECK(top == 1);
    CHECK(columns % 4 == 0);
    CHECK(columns >= 8);
    CHECK(side % columns == 0);
    CHECK(builder.vertex_count() == side + columns);
  }
}

TEST_CASE("facets along a pole are as many as along half a turn of a sphere of its size, or fewer, however thin the pole is") {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const double radius = std::pow(10.0, random.uniform(-6, 6)), length = radius * std::pow(10.0, random.uniform(0, 4));
    const double size = std::hypot(length, std::sqrt(8.0) * radius), tolerance = size * std::pow(10.0, random.uniform(-3, -1));
    const bool cone = trial % 2 == 0;
    brep::Builder pole, ball;
    if (cone) {
      Cone::make({0, 0, 0}, {0, 0, length}, radius, 0.5 * radius)->approximate(tolerance, pole);
    } else {
      Cylinder::make({0, 0, 0}, {0, 0, length}, radius)->approximate(tolerance, pole);
    }
    Sphere::make({0, 0, 0}, size / std::sqrt(12.0))->approximate(tolerance, ball);
    const double columns = static_cast<double>(pole.corners(pole.face_count() - 1).size());  // the last face is a cap
    const double rows = (pole.face_count() - 2) / columns, half_turn = 2.0 * std::sqrt(ball.face_count() / 6.0);
    CAPTURE(cone, length / radius, tolerance / size);
    CHECK(rows <= half_turn);
    CHECK(rows <= std::max(1.0, length / (2.0 * radius) * columns));  // and no wider than they are long, within a factor of 2
  }
}

TEST_CASE("a sphere is cut in 6 n^2 quadrilaterals that share their vertices, symmetric to the last bit") {
  for (const double tolerance : {10.0, 0.1, 0.01, 1e-3}) {
    brep::Builder builder;
    Sphere::make({0, 0, 0}, 1)->approximate(tolerance, builder);
    const std::uint32_t faces = builder.face_count();
    CHECK(faces % 6 == 0);
    CHECK(builder.vertex_count() == faces + 2);
    for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) {
      bool mirrored = false;
      for (std::uint32_t w = 0; w < builder.vertex_count(); ++w) { mirrored = mirrored || builder.position(w) == -builder.position(v); }
      CHECK(mirrored);
      CHECK(std::abs(glm::length(builder.position(v)) - 1.0) <= 4 * unit_roundoff);
    }
  }
}

TEST_CASE("several objects go into one builder side by side") {
  brep::Builder builder;
  for (const auto& [name, shape] : shapes()) { PlacedObject(shape.object).approximate(0.1, builder); }
  const auto result = brep::close<Shell>(builder);
  CHECK(result.defects.empty());
  CHECK(brep::shell_count(*result.brep) == shapes().size());
}
