// SPDX-License-Identifier: MIT

// The methods with which the hierarchy is compared: quad-trees on separate polygons, uniform meshes with a full matrix, shooting.

#include <numbers>

#include <radiosity/run/uniform.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

using namespace radiosity;
using scenes::solved;

namespace {

Options coarsest() { return {.epsilon = 0.05, .min_area = 5e-4, .audit_points = 0}; }

double relative_difference(const Solution& a, const Solution& b) {
  REQUIRE(a.radiosity.size() == b.radiosity.size());
  double square = 0.0;
  double norm = 0.0;
  for (std::size_t i = 0; i < a.radiosity.size(); ++i) {
    if (!a.hierarchy[i].leaf()) { continue; }
    square += a.area[i] * glm::dot(a.radiosity[i] - b.radiosity[i], a.radiosity[i] - b.radiosity[i]);
    norm += a.area[i] * glm::dot(a.radiosity[i], a.radiosity[i]);
  }
  return std::sqrt(square / norm);
}

}  // namespace

TEST_CASE("furnace: a full matrix on a uniform mesh gives B = 1, with and without things in the room") {
  for (const auto& scene : {scenes::furnace_cube(0.9), scenes::furnace_with_things(0.5)}) {
    UniformOptions options;
    options.max_area = 0.01;
    const Solution solution = solved(solve_uniform(scene, options));
    CHECK(solution.audit.links == solution.audit.leaves * solution.audit.leaves);
    // Rows are closed to 1e-9 and stored as float (2^-24, averaged over a row); the residual is 1e-8, and both grow by 1 / (1 - rho).
    for (const MeshFace& face : solution.mesh.faces) { CHECK(std::abs(face.radiosity.x - 1.0) < 1e-5); }
  }
}

TEST_CASE("shooting converges to the solution of the full matrix") {
  const Scene scene = scenes::two_plates(0.7);
  UniformOptions options;
  options.max_area = 0.02;
  const Solution dense = solved(solve_uniform(scene, options));
  options.solver = UniformSolver::progressive;
  options.threads = 1;  // a row is too short to share
  double before = 1.0;
  for (const double unshot : {0.1, 0.01, 1e-4}) {
    CAPTURE(unshot);
    options.unshot = unshot;
    const Solution shot = solved(solve_uniform(scene, options));
    const double difference = relative_difference(dense, shot);
    // What is unshot is still to come, times at most 1 / (1 - rho F), F = .2: below 1.2 times itself in power. Spread over
    // half of the area, its L2 norm is about as large.
    CHECK(difference < 2.0 * unshot + 1e-6);
    CHECK(difference < before);
    before = difference;
    CHECK(shot.audit.residual <= unshot);
  }
}

TEST_CASE("polygons that share no edge: separate quad-trees are the hierarchy") {
  const Scene scene = scenes::two_plates(0.5);
  Options options = coarsest();
  const Solution hierarchical = solved(solve(scene, options));
  options.topology = Topology::separate;
  const Solution quadtrees = solved(solve(scene, options));
  REQUIRE(hierarchical.hierarchy.size() > 20);
  CHECK(quadtrees.links.size() == hierarchical.links.size());
  CHECK(relative_difference(hierarchical, quadtrees) == 0.0);
}

TEST_CASE("separate polygons know nothing of their neighbours: a furnace still holds, T-vertices stay") {
  Options options = coarsest();
  options.topology = Topology::separate;
  const Solution solution = solved(solve(scenes::furnace_with_things(0.5), options));
  // Closed rows make every leaf 1, and so every average of leaves.
  for (const MeshFace& face : solution.mesh.faces) { CHECK(std::abs(face.radiosity.x - 1.0) < 1e-6); }
  for (const MeshCorner& corner : solution.mesh.corners) { CHECK(std::abs(corner.radiosity.x - 1.0) < 1e-6); }

  // No vertex belongs to faces of two polygons: six walls of a cube have 24 corners where the shared mesh has 8.
  options.epsilon = 1.0;
  options.min_area = 1.0;
  CHECK(solved(solve(scenes::furnace_cube(0.5), options)).mesh.positions.size() == 24);
  options.topology = Topology::shared;
  CHECK(solved(solve(scenes::furnace_cube(0.5), options)).mesh.positions.size() == 8);
}

TEST_CASE("the parts of a separate polygon stay in its plane, those of a shared one follow the object") {
  Scene scene = scenes::furnace_sphere(0.5);
  Options options = coarsest();
  const auto farthest_in = [](const Solution& solution) {
    double least = 1.0;
    for (const glm::dvec3& p : solution.mesh.positions) { least = std::min(least, glm::length(p)); }
    return least;
  };
  const auto area = [](const Solution& solution) {
    double sum = 0.0;
    for (std::size_t i = 0; i < solution.area.size(); ++i) { sum += solution.hierarchy[i].leaf() ? solution.area[i] : 0.0; }
    return solution.frame.to_scene_area(sum);
  };
  const double sphere = 4.0 * std::numbers::pi;
  const Solution shared = solved(solve(scene, options));
  CHECK(farthest_in(shared) > 1.0 - 1e-9);
  CHECK(std::abs(area(shared) - sphere) < 1e-3 * sphere);
  options.topology = Topology::separate;
  const Solution separate = solved(solve(scene, options));
  CHECK(farthest_in(separate) < 1.0 - 1e-3);  // the first approximation has a chord error of 1 % of the ball's bounds
  CHECK(farthest_in(separate) > 0.9);
  CHECK(area(separate) < 0.995 * sphere);
}

TEST_CASE("a dense solution on the leaves of a run differs from it by its links alone", "[accuracy]") {
  const Scene scene = scenes::room_with_box();
  double before = 1.0;
  for (const double epsilon : {0.2, 0.02}) {
    Options options = coarsest();
    options.epsilon = epsilon;
    options.min_area = 2e-3;
    options.compare = 5000;
    const Solution solution = solved(solve(scene, options));
    REQUIRE(solution.comparison);
    REQUIRE(solution.comparison->dense.size() == solution.hierarchy.size());
    Solution dense = solution;
    dense.radiosity = solution.comparison->dense;
    const double links = relative_difference(dense, solution);
    CHECK(links > 0.0);
    CHECK(links < before);
    before = links;
    CHECK(solution.comparison->other.corners.size() == solution.mesh.corners.size());
  }
  // Where every link is one between leaves, only the noise of visibility is left: different segments are cast.
  CHECK(before < 0.02);
}

TEST_CASE("a mesh that is too fine for a matrix is refused, a comparison on too many leaves is left out") {
  UniformOptions options;
  options.max_area = 1e-6;
  options.max_leaves = 1000;
  const Outcome refused = solve_uniform(scenes::two_plates(0.5), options);
  CHECK_FALSE(refused.solution);
  CHECK(refused.failure.kind == Failure::Kind::invalid_options);
  Options few = coarsest();
  few.compare = 10;
  const Solution solution = solved(solve(scenes::two_plates(0.5), few));
  REQUIRE(solution.comparison);
  CHECK(solution.comparison->dense.empty());
}
