// SPDX-License-Identifier: MIT
// Polygons whose outline comes within rounding of itself: the scene is prepared, the parts have the area of the polygon, and the light that
// arrives there is that of the same polygon with a visible gap.

#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/polygon.hpp>

#include <raycast/objects/polygon.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "brep/near_contacts.hpp"
#include "catch.hpp"
#include "roots.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

// The area of the leaves of a scene, in squares of its extent; none may look away from n if it has area.
double area_of_leaves(const radiosity::DiscreteScene& scene, const glm::dvec3& n) {
  const radiosity::SurfaceBRep& brep = scene.surfaces[0].brep;
  std::vector<glm::dvec3> positions;
  for (const brep::VertexId v : brep::vertices(brep)) { positions.push_back(brep.data(v).position); }
  const double square = brep::extent(positions) * brep::extent(positions);
  double sum = 0.0;
  for (const std::uint32_t i : roots::leaves_of(scene)) {
    const radiosity::Node& node = scene.hierarchy[i];
    sum += node.area / square;
    CHECK((glm::dot(node.normal, n) > 0.0 || node.area <= 1e-8 * square));
  }
  return sum;
}

double flux_on(const std::vector<glm::dvec3>& outline) {
  auto polygon = raycast::Polygon::make(outline);
  REQUIRE(polygon);
  const radiosity::Scene scene = roots::closed_room({scenes::object("table", polygon.object, 0)});
  const radiosity::Solution solution = scenes::solved(scene, {.audit_points = 0});
  std::set<std::uint32_t> leaves;  // the surfaces of the room are 0 to 5, the lamp is 6
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    if (face.surface == 7) { leaves.insert(face.node); }
  }
  double flux = 0.0;
  for (const std::uint32_t i : leaves) { flux += solution.area[i] * solution.radiosity[i].x; }
  return flux;
}

}  // namespace

TEST_CASE("polygons within rounding of themselves: their parts have their area") {
  const std::uint32_t start = test::seed();
  unsigned as_they_are = 0;
  for (std::uint32_t seed = start; seed < start + 400; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    const std::vector<glm::dvec3> points = near_contacts::outline(random);
    if (points.size() < 4) { continue; }
    const double size = brep::extent(points);
    radiosity::Scene scene;
    scene.materials = {{"white", radiosity::Color{0.7}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
    if (auto polygon = raycast::Polygon::make(points)) {  // what crosses itself is refused here, as a rule
      ++as_they_are;
      scene.objects = {scenes::object("polygon", polygon.object, 1)};
      const double area = brep::area(points) / (size * size);
      CHECK(std::abs(area_of_leaves(*roots::roots_of(scene), brep::normal(points)) - area) <= 1e-8);
    }
  }
  CHECK(as_they_are > 50);
}

TEST_CASE("a notch within rounding of the opposite side: as much light arrives as with a visible gap", "[accuracy]") {
  const auto table = [](double gap) {
    return std::vector<glm::dvec3>{{0.2, 0.2, 0.5},       {0.8, 0.2, 0.5},  {0.8, 0.8, 0.5}, {0.55, 0.8, 0.5},
                                   {0.5, 0.2 + gap, 0.5}, {0.45, 0.8, 0.5}, {0.2, 0.8, 0.5}};
  };
  const double visible = flux_on(table(1e-4));
  for (const double gap : {1e-12, 1e-14, 1e-15, 1e-16}) {
    CAPTURE(gap);
    CHECK(std::abs(flux_on(table(gap)) - visible) < 0.01 * visible);
  }
}
