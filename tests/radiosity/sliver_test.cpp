// SPDX-License-Identifier: MIT
// Patches without width. Where coplanar polygons of a file were joined, borders of faces have many vertices that lie on a straight line but
// for rounding; to cut such a face into convex parts leaves slivers, and to cut it into a ring of cells must leave none that overlap.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/objects/box.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>

#include <radiosity/radiosity.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

// Solves a room with a floor of two triangles under a lamp. They meet along a line from one corner of the floor to the opposite one. The
// radiosity of the brightest corner of faces that do not shine and are wider than a sliver.
double brightest_with(const std::vector<glm::dvec3>& line) {
  radiosity::Scene scene;
  scene.materials = {{"grey", radiosity::Color(0.5), radiosity::Color(0.0)}, {"lamp", radiosity::Color(0.0), radiosity::Color(10.0)}};
  const auto add = [&](const char* name, const auto& made, std::uint32_t material, bool inside = false) {
    REQUIRE(made);
    scene.objects.push_back(scenes::object(name, made.object, material, inside));
  };
  add("room", raycast::BoxObject::make({-0.1, -0.1, 0}, {2.1, 2.1, 2}), 0, true);
  std::vector<glm::dvec3> corners{{0, 0, 0.01}, {2, 0, 0.01}, {2, 2, 0.01}, {0, 2, 0.01}};
  std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}, {2, 3, 0}};
  corners.insert(corners.end(), line.begin(), line.end());
  for (std::uint32_t k = 0; k < line.size(); ++k) {
    faces[0].push_back(3 + static_cast<std::uint32_t>(line.size()) - k);
    faces[1].push_back(4 + k);
  }
  add("floor", raycast::Mesh::make(corners, faces), 0);
  add("lamp", raycast::Polygon::make({{0.9, 0.9, 1.9}, {0.9, 1.1, 1.9}, {1.1, 1.1, 1.9}, {1.1, 0.9, 1.9}}), 1);
  const radiosity::Options options{.audit_points = 0};
  const radiosity::Solution solution = scenes::solved(scene, options);
  CHECK(*std::max_element(solution.row_sum.begin(), solution.row_sum.end()) <= 1.1);
  double most = 0.0;
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    double of_face = 0.0;
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      of_face = std::max(of_face, solution.mesh.corners[face.first_corner + k].radiosity.x);
    }
    if (of_face < 9.0 && solution.area[face.node] > 1e-4) { most = std::max(most, of_face); }
  }
  return most;
}

}  // namespace

namespace {

// Of so many floors with random lines, each off a straight one by 1e-13 to 1e-6 of a metre.
void check_slivers(int runs) {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  const double without = brightest_with({});
  for (int run = 0; run < runs; ++run) {
    const double width = std::pow(10.0, number(-13.0, -6.0));
    CAPTURE(run, width);
    const glm::dvec3 across = glm::normalize(glm::dvec3(2, -2, 0));
    std::vector<glm::dvec3> line;
    for (int k = 1; k < 24; ++k) { line.push_back(glm::dvec3(k / 12.0, k / 12.0, 0.01) + number(-width, width) * across); }
    CHECK(brightest_with(line) < 1.1 * without);
  }
}

}  // namespace

TEST_CASE("slivers in a wall: no leaf receives more than there is, and the corners around them are as bright as without them") {
  check_slivers(1);
}

TEST_CASE("slivers in a wall: the same, a dozen times", "[slow]") { check_slivers(12); }
