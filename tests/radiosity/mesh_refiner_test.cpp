// SPDX-License-Identifier: MIT

// Meshes in gathered light (Options::mesh_error): they come as near to that light as was asked for, or say so.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glm/vec3.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

radiosity::Options coarse(double mesh_error) {
  return {.epsilon = 0.08, .min_area = 5e-3, .mesh_error = mesh_error, .audit_points = 0, .threads = 1};
}

// A box at random on a floor under a square lamp: an edge of a shadow that no regular mesh follows.
radiosity::Scene box_on_floor(std::uint64_t seed) {
  radiosity::Random random{seed, 0};
  const auto uniform = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  const glm::dvec3 at{uniform(-0.5, 0.1), uniform(-0.5, 0.1), 0.0};
  const glm::dvec3 size{uniform(0.2, 0.4), uniform(0.2, 0.4), uniform(0.2, 0.6)};
  radiosity::Scene scene{{{"white", radiosity::Color{0.6}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{10.0}}},
                         {}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true), scenes::object("box", scenes::box(at, at + size), 0),
                   scenes::square("lamp", {0.4, 0.3, 1.5}, 0.15, false, 1)};
  return scene;
}

bool same(const radiosity::Mesh& a, const radiosity::Mesh& b) {
  if (a.positions != b.positions || a.corners.size() != b.corners.size() || a.faces.size() != b.faces.size()) { return false; }
  for (std::size_t c = 0; c < a.corners.size(); ++c) {
    if (a.corners[c].vertex != b.corners[c].vertex || a.corners[c].radiosity != b.corners[c].radiosity) { return false; }
  }
  return true;
}

}  // namespace

TEST_CASE("a refined mesh has the error that was asked for, and less takes more faces", "[mesh][accuracy]") {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    CAPTURE(seed);
    const radiosity::Scene scene = box_on_floor(seed);
    std::uint64_t faces = 0;
    for (const double wanted : {0.04, 0.02}) {
      const radiosity::Solution solution = scenes::solved(scene, coarse(wanted));
      REQUIRE(solution.audit.mesh);
      const radiosity::MeshRefinement& mesh = *solution.audit.mesh;
      CHECK(mesh.before.relative_l2 > wanted);  // else the test says nothing
      REQUIRE(solution.refined);
      CHECK(mesh.met);
      CHECK(mesh.after.relative_l2 <= wanted);
      CHECK(mesh.faces_after == solution.refined->faces.size());
      CHECK(mesh.faces_after > faces);
      faces = mesh.faces_after;
    }
  }
}

TEST_CASE("a refined mesh has the same bits for any number of threads, and leaves the solution alone", "[mesh]") {
  const radiosity::Scene scene = box_on_floor(3);
  radiosity::Options options = coarse(0.03);
  const radiosity::Solution one = scenes::solved(scene, options);
  options.threads = 3;
  const radiosity::Solution three = scenes::solved(scene, options);
  options.mesh_error.reset();
  const radiosity::Solution without = scenes::solved(scene, options);
  REQUIRE(one.refined);
  REQUIRE(three.refined);
  CHECK(same(*one.refined, *three.refined));
  CHECK_FALSE(without.refined);
  CHECK_FALSE(without.audit.mesh);
  CHECK(same(one.mesh, without.mesh));
  CHECK(one.radiosity == without.radiosity);
}

TEST_CASE("the mesh of a furnace is not refined", "[mesh][accuracy]") {
  const radiosity::Solution solution = scenes::solved(scenes::furnace_with_things(0.5), coarse(0.01));
  REQUIRE(solution.audit.mesh);
  CHECK(solution.audit.mesh->met);
  CHECK_FALSE(solution.refined);
  CHECK(solution.audit.mesh->faces_after == solution.audit.mesh->faces_before);
}

TEST_CASE("a mesh error that leaves cannot have is refused", "[mesh]") {
  radiosity::Options options = coarse(0.05);
  options.reconstruction = radiosity::Reconstruction::constant;
  const radiosity::Outcome outcome = radiosity::solve(box_on_floor(1), options);
  CHECK_FALSE(outcome.solution);
  CHECK(outcome.failure.kind == radiosity::Failure::Kind::invalid_options);
}
