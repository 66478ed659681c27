// SPDX-License-Identifier: MIT

// A user's meshing strategy: ours given as one makes the same bits; one that halves faces keeps every BRep valid, and the laws of light
// hold.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/split_objects.hpp>
#include <brep/split_plane.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "generations.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

// A split object: across the longest edge, through the mean of the corners.
struct Halve {
  brep::Cut operator()(const radiosity::SurfaceBRep& brep, brep::FaceId f) const {
    const auto corners = radiosity::corner_polygon(brep, f);
    glm::dvec3 mean{0.0}, along{0.0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      mean += corners[i] / static_cast<double>(corners.size());
      const glm::dvec3 edge = corners[(i + 1) % corners.size()] - corners[i];
      if (glm::length(edge) > glm::length(along) * (1.0 + 1e-9)) { along = edge; }
    }
    return brep::AlongPlane{mean, along}(brep, f);
  }
};

radiosity::Options meshing_options() { return {.epsilon = 0.05, .min_area = 2e-3, .audit_points = 400}; }

// Squared norm of the reflected radiosity.
double reflected_square(const radiosity::Scene& scene, const radiosity::Solution& solution) {
  const auto inputs = radiosity::surfaces(scene);
  double sum = 0.0;
  for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
    if (!solution.hierarchy[i].leaf()) { continue; }
    const auto off = solution.radiosity[i] - scene.materials[inputs[solution.hierarchy[i].surface].material].emission;
    sum += solution.area[i] * glm::dot(off, off);
  }
  return sum;
}

}  // namespace

TEST_CASE("regular refinement as a user's meshing strategy gives the same bits") {
  radiosity::Options options = meshing_options();
  options.audit_points = 0;
  for (const radiosity::Scene& scene : {scenes::room_with_box(), scenes::furnace_with_things(0.5)}) {
    options.meshing = nullptr;
    const radiosity::Solution ours = scenes::solved(scene, options);
    std::size_t splits = 0;
    options.meshing = [&](const radiosity::LeafFace& leaf) {
      ++splits;
      return radiosity::RegularMeshing{}(leaf);
    };
    CHECK((scenes::solved(scene, options).radiosity == ours.radiosity));  // not to be printed
    CHECK(splits > 10);
  }
}

TEST_CASE("faces halved by a split object: two children a node, valid BReps, no area lost, and the same light within the errors") {
  const radiosity::Scene scene = scenes::room_with_box();
  radiosity::Options options = meshing_options();
  const radiosity::Solution ours = scenes::solved(scene, options);
  options.meshing = radiosity::CutBy{Halve{}};
  int generations = 0;
  const radiosity::Solution halved = scenes::solved(scene, options, watch_generations(generations));
  CHECK(generations > 2);
  std::size_t inner = 0;
  for (const radiosity::Node& node : halved.hierarchy) {
    if (node.leaf()) { continue; }
    ++inner;
    if (node.child_count != 2) { continue; }
    const double parts = halved.hierarchy[node.first_child].area + halved.hierarchy[node.first_child + 1].area;
    CHECK(std::abs(parts - node.area) <= 1e-12 * node.area);  // a few roundings of coordinates of the order of the size
  }
  CHECK(inner > 20);
  // A mean is a projection: means over surfaces differ by no more than the solutions do, and these by no more than both errors. The
  // errors are measured relative to the reflected light; the upper ends of their 95 % intervals are taken.
  double square = 0.0;
  for (std::size_t s = 0; s < ours.audit.surfaces.size(); ++s) {
    const auto off = ours.audit.surfaces[s].radiosity - halved.audit.surfaces[s].radiosity;
    square += ours.audit.surfaces[s].area * glm::dot(off, off);
  }
  REQUIRE(ours.audit.leaf_error);
  REQUIRE(halved.audit.leaf_error);
  const double errors = ours.audit.leaf_error->high + halved.audit.leaf_error->high;
  CAPTURE(ours.audit.leaf_error->high, halved.audit.leaf_error->high);
  CHECK(std::sqrt(square) <= errors * std::sqrt(reflected_square(scene, ours)));
}

TEST_CASE("halved faces of curved objects in a furnace: valid BReps, and B = E / (1 - rho)") {
  const double rho = 0.5;
  const radiosity::Scene scene = scenes::furnace_with_things(rho);
  radiosity::Options options = meshing_options();
  options.audit_points = 0;
  options.meshing = radiosity::CutBy{Halve{}};
  int generations = 0;
  const radiosity::Solution halved = scenes::solved(scene, options, watch_generations(generations));
  CHECK(generations > 2);
  REQUIRE(halved.audit.closure);
  const double glow = scene.materials[0].emission.x / (1.0 - rho);
  for (std::size_t i = 0; i < halved.hierarchy.size(); ++i) {
    if (!halved.hierarchy[i].leaf() || !(halved.area[i] > 0.0)) { continue; }
    CHECK(halved.radiosity[i].x == test::Approx(glow).epsilon(1e-7));  // ten times the residual of the solver
  }
}
