// SPDX-License-Identifier: MIT
// Extrusions and elevation grids of VRML 97 have areas and volumes that are known.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "vrml97.hpp"

using models::noted;

namespace {

apps::Model read_shape(const std::string& geometry) { return vrml97::read("Shape { geometry " + geometry + " }"); }

std::vector<glm::dvec3> outline_of(const apps::Model& model, std::size_t polygon) {
  std::vector<glm::dvec3> points;
  for (std::size_t i = model.first_corner[polygon]; i < model.first_corner[polygon + 1]; ++i) {
    points.push_back(model.positions[model.corners[i]]);
  }
  return points;
}

// The sum of the vector areas' lengths, and the volume by the divergence theorem, positive when faces look outwards.
struct SweptExtent {
  double area = 0.0, volume = 0.0;
};
SweptExtent swept_extent(const apps::Model& model) {
  SweptExtent sum;
  for (std::size_t p = 0; p < model.polygons(); ++p) {
    const std::vector<glm::dvec3> points = outline_of(model, p);
    glm::dvec3 area(0.0);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const glm::dvec3 triangle = 0.5 * glm::cross(points[i] - points[0], points[i + 1] - points[0]);
      area += triangle;
      sum.volume += glm::dot(triangle, points[0]) / 3.0;
    }
    sum.area += glm::length(area);
  }
  return sum;
}

}  // namespace

TEST_CASE("VRML 97: extrusions have the volumes of prisms, pyramids and rings, and look outwards") {
  const std::string square = " crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ] ";
  // Bounds of rounding: coordinates are of the order of 10, with six digits in the text.
  CHECK(swept_extent(read_shape("Extrusion { }")).volume == Approx(4.0));
  CHECK(swept_extent(read_shape("Extrusion { }")).area == Approx(4 + 4 + 4 * 2));
  CHECK(swept_extent(read_shape("Extrusion { ccw FALSE }")).volume == Approx(-4.0));
  CHECK(swept_extent(read_shape("Extrusion { beginCap FALSE }")).area == Approx(12.0));
  CHECK(swept_extent(read_shape("Extrusion { beginCap FALSE endCap FALSE }")).area == Approx(8.0));
  CHECK(swept_extent(read_shape("Extrusion { scale [ 1 1, 0 0 ] }")).volume == Approx(4.0 / 3.0));
  CHECK(swept_extent(read_shape("Extrusion { scale 2 0.25 orientation 0 1 0 0.7 }")).volume == Approx(2.0));
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i) {  // straight spines in any direction, with points between their ends
    const auto number = [&random] { return std::uniform_real_distribution(-3.0, 3.0)(random); };
    const glm::dvec3 from(number(), number(), number()), along(number(), number(), number());
    const std::string spine = "spine [ " + vrml_twins::text(from) + ", " + vrml_twins::text(from) + ", " +
                              vrml_twins::text(from + 0.3 * along) + ", " + vrml_twins::text(from + along) + " ]";
    CHECK(swept_extent(read_shape("Extrusion { " + spine + square + "}")).volume == Approx(4.0 * glm::length(along)).epsilon(1e-4));
  }
  CHECK(swept_extent(read_shape("Extrusion { spine [ 0 0 0, 0 -3 0 ] }")).volume == Approx(12.0));

  // A closed spine, a regular polygon: between two prisms over polygons of circumradius R - 1 and R + 1. Its start makes no difference,
  // nor does a spine that runs the other way round.
  constexpr int n = 12;
  const double R = 5.0, ring = 2.0 * (0.5 * n * std::sin(2.0 * std::numbers::pi / n)) * ((R + 1) * (R + 1) - (R - 1) * (R - 1));
  for (const double turn : {1.0, -1.0}) {
    std::string spine;
    for (int i = 0; i <= n; ++i) {
      const double angle = turn * 2.0 * std::numbers::pi * (i % n) / n;
      spine += vrml_twins::text({R * std::cos(angle), R * std::sin(angle), 0.0}) + ", ";
    }
    const apps::Model made = read_shape("Extrusion { spine [ " + spine + "]" + square + "}");
    CHECK(swept_extent(made).volume == Approx(ring).epsilon(1e-5));
    CHECK(made.polygons() == 4 * n);  // no caps
  }
  // It bends to one side and then to the other, in one plane: the cross-section keeps its z across that plane, so all is 2 high.
  const apps::Model bent = read_shape("Extrusion { spine [ 0 0 0, 0 4 0, 4 8 0, 4 12 0 ] }");
  for (const glm::dvec3& p : bent.positions) { CHECK(std::abs(std::abs(p.z) - 1.0) < 1e-12); }
  CHECK(models::scene("a.wrl", vrml_twins::head + "Shape { geometry Extrusion { spine [ 0 0 0, 0 4 0, 4 8 0, 4 12 0 ] } }")
            .scene.objects.size() == 3);

  // All points in one place, turned: a solid of revolution, here a cylinder of 24 slices.
  std::string places, turns;
  for (int i = 0; i <= 24; ++i) {
    places += "0 0 0, ";
    turns += "0 0 1 " + std::to_string(2.0 * std::numbers::pi * i / 24) + ", ";
  }
  const apps::Model round =
      read_shape("Extrusion { crossSection [ 0 1, 2 1, 2 -1, 0 -1 ] spine [ " + places + "] orientation [ " + turns + "] }");
  CHECK(std::abs(swept_extent(round).volume) == Approx(2.0 * 12.0 * 4.0 * std::sin(2.0 * std::numbers::pi / 24)).epsilon(1e-5));
}

TEST_CASE("VRML 97: elevation grids have the area of their plane and look up") {
  std::string heights;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) { heights += std::to_string(0.5 * i * 2.0 + 0.25 * j * 3.0) + " "; }
  }
  const std::string grid = "ElevationGrid { xDimension 3 zDimension 4 xSpacing 2 zSpacing 3 height [ " + heights + "] ";
  const apps::Model model = read_shape(grid + "}");
  CHECK(model.polygons() == 6);
  CHECK(swept_extent(model).area == Approx(4.0 * 9.0 * std::sqrt(1.0 + 0.25 + 0.0625)));
  const auto up = [](const apps::Model& m) {
    const auto p = outline_of(m, 0);
    return glm::cross(p[1] - p[0], p[2] - p[0]).y > 0.0;
  };
  CHECK(up(model));
  CHECK_FALSE(up(read_shape(grid + "ccw FALSE }")));
  CHECK_FALSE(model.materials[0].two_sided);
  CHECK(read_shape(grid + "solid FALSE }").materials[0].two_sided);
  const apps::Model colored =
      read_shape(grid + "colorPerVertex FALSE color Color { color [ 0.1 0 0, 0.2 0 0, 0.3 0 0, 0.4 0 0, 0.5 0 0, 0.6 0 0 ] } }");
  for (std::size_t p = 0; p < 6; ++p) { CHECK(colored.materials[colored.material[p]].reflectance->x == Approx(0.1 * (1.0 + double(p)))); }
  const std::string with_ball =
      "Shape { geometry Sphere { } } Shape { geometry ElevationGrid { xDimension 1e9 zDimension 1e9 height [ 1 ] } }";
  CHECK(noted(vrml97::read(with_ball).notes, "grids and extrusions with fewer numbers than they need"));
}
