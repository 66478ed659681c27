// SPDX-License-Identifier: MIT

// The whole path against answers that are known: furnaces, exchange between plates, energy, invariance, determinism.

#include <atomic>
#include <chrono>
#include <string_view>
#include <thread>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "generations.hpp"
#include "scenes.hpp"
#include "solved.hpp"

using radiosity::Options;
using radiosity::Outcome;
using radiosity::Scene;
using radiosity::Solution;
using scenes::solved;

namespace {

// Fast options: coarse refinement and no audit.
Options coarse() { return {.epsilon = 0.03, .min_area = 1e-4, .audit_points = 0}; }

// Largest |B - 1| over all corners and all exposed leaves.
double furnace_error(const Solution& solution) {
  double worst = 0.0;
  for (const auto& corner : solution.mesh.corners) { worst = std::max(worst, std::abs(corner.radiosity.x - 1.0)); }
  for (const auto& face : solution.mesh.faces) { worst = std::max(worst, std::abs(face.radiosity.x - 1.0)); }
  return worst;
}

}  // namespace

TEST_CASE("furnace cube: B = 1 everywhere and every row sums to 1") {
  for (const double rho : {0.1, 0.5, 0.9, 0.99}) {
    CAPTURE(rho);
    const Solution solution = solved(scenes::furnace_cube(rho), coarse());
    CHECK(furnace_error(solution) < 1e-3);
    CHECK(solution.audit.row_sum.min > 1.0 - 1e-3);
    CHECK(solution.audit.row_sum.max < 1.0 + 1e-3);
    CHECK(solution.audit.rays == 0);  // nothing stands inside a convex room
    CHECK(solution.audit.iterations <= 20);
    CHECK(solution.audit.channels == 1);
  }
}

TEST_CASE("form factors of an evenly meshed cube sum to 1 at every mesh size, before any correction") {
  for (const int n : {1, 2, 4, 8}) {
    CAPTURE(n);
    Options options = coarse();
    options.epsilon = 1e-9;                          // every pair is refined
    options.min_area = 0.25 * 1.01 / (6.0 * n * n);  // down to n x n leaves a wall: their quarters would be smaller,
    options.light_epsilon = 1.0;                     // all of them
    const Solution solution = solved(scenes::furnace_cube(0.99), options);
    CHECK(solution.audit.leaves == 6u * static_cast<unsigned>(n * n));
    // Far rules err by up to 2e-5 of a form factor (exchange.hpp), links are floats.
    CHECK(std::abs(solution.audit.computed_row_sum.min - 1.0) < 2e-5);
    CHECK(std::abs(solution.audit.computed_row_sum.max - 1.0) < 2e-5);
  }
}

TEST_CASE("furnace sphere from inside: B = 1 everywhere and every row sums to 1") {
  for (const double rho : {0.1, 0.5, 0.9, 0.99}) {
    CAPTURE(rho);
    const Solution solution = solved(scenes::furnace_sphere(rho), coarse());
    CHECK(furnace_error(solution) < 1e-3);
    CHECK(solution.audit.row_sum.min > 1.0 - 1e-3);
    CHECK(solution.audit.row_sum.max < 1.0 + 1e-3);
    CHECK(solution.audit.rays == 0);
  }
}

TEST_CASE("furnace with things in it: B = 1 whatever stands in the room") {
  const Solution solution = solved(scenes::furnace_with_things(0.9), coarse());
  CHECK(furnace_error(solution) < 1e-3);
  CHECK(solution.audit.rays > 0);
  REQUIRE(solution.audit.closure);
}

TEST_CASE("two plates: the exchange between them is the analytic form factor") {
  const double rho = 0.5;
  const Solution solution = solved(scenes::two_plates(rho), coarse());
  double exchange = 0.0;
  for (const radiosity::Link& link : solution.links) { exchange += static_cast<double>(link.exchange); }
  const double area = 1.0 * solution.frame.scale * solution.frame.scale;
  CHECK(exchange / area == test::Approx(0.1998248956983874).epsilon(1e-6));
  CHECK(solution.audit.rays == 0);
}

TEST_CASE("energy: what is emitted is absorbed or escapes") {
  for (const Scene& scene : {scenes::furnace_cube(0.9), scenes::room_with_box(), scenes::two_plates(0.8)}) {
    const Solution solution = solved(scene, coarse());
    CHECK(solution.audit.energy_balance < 1e-6);  // the residual is 1e-8, amplified by at most 1 / (1 - rho)
  }
  CHECK(solved(scenes::two_plates(0.0), coarse()).audit.links == 0);
  CHECK(std::abs(solved(scenes::room_with_box(), coarse()).audit.escaped) < 1e-9);
  CHECK(solved(scenes::two_plates(0.8), coarse()).audit.escaped > 0.5);
}

TEST_CASE("BF-refinement meets its estimate with fewer links where less light goes, the same with any number of threads") {
  Options options = coarse();
  options.refinement = radiosity::Refinement::a_posteriori;
  std::size_t links = 0;
  for (const double target : {0.2, 0.1, 0.05}) {
    options.target = target;
    options.threads = 1;
    const Solution solution = solved(scenes::room_with_box(), options);
    REQUIRE(solution.audit.estimated_error);
    CHECK(*solution.audit.estimated_error <= target);
    CHECK(solution.links.size() >= links);
    links = solution.links.size();
    options.threads = 3;
    const Solution same = solved(scenes::room_with_box(), options);
    CHECK(same.radiosity == solution.radiosity);
  }
  const Solution furnace = solved(scenes::furnace_cube(0.9), options);
  CHECK(furnace_error(furnace) < 1e-3);
}

TEST_CASE("every BRep is valid after every generation of refinement, and v - e + f = 2 (s - h)") {
  for (const Scene& scene : {scenes::furnace_cube(0.5), scenes::furnace_sphere(0.5), scenes::furnace_with_things(0.5),
                             scenes::room_with_box(), scenes::two_plates(0.5)}) {
    int generations = 0;
    const radiosity::Control control = watch_generations(generations);
    solved(scene, coarse(), control);
    CHECK(generations >= 1);
  }
}

TEST_CASE("scaling by a power of two gives the same bits") {
  const Solution one = solved(scenes::furnace_with_things(0.7), coarse());
  for (const double scale : {0x1p-20, 0x1p20}) {
    const Solution other = solved(scenes::moved(scenes::furnace_with_things(0.7), scale, glm::dvec3{0.0}), coarse());
    REQUIRE(other.links.size() == one.links.size());
    CHECK((other.radiosity == one.radiosity));
    CHECK((other.row_sum == one.row_sum));
    for (std::size_t i = 0; i < one.links.size(); ++i) { REQUIRE(other.links[i].exchange == one.links[i].exchange); }
    for (std::size_t i = 0; i < one.mesh.positions.size(); ++i) { REQUIRE(other.mesh.positions[i] == one.mesh.positions[i] * scale); }
  }
}

TEST_CASE("moving by 1e5 sizes changes results by less than 1e-6") {
  const Solution one = solved(scenes::room_with_box(), coarse());
  const Solution other = solved(scenes::moved(scenes::room_with_box(), 1.0, {1e5, -3e4, 7e4}), coarse());
  REQUIRE(other.radiosity.size() == one.radiosity.size());
  double square = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < one.radiosity.size(); ++i) {
    square += one.area[i] * (other.radiosity[i].x - one.radiosity[i].x) * (other.radiosity[i].x - one.radiosity[i].x);
    size += one.area[i] * one.radiosity[i].x * one.radiosity[i].x;
  }
  CHECK(std::sqrt(square / size) < 1e-6);
}

TEST_CASE("the same bits with 1, 2 and 5 threads, and from run to run") {
  Options options = coarse();
  options.audit_points = 100;
  options.threads = 1;
  const Solution one = solved(scenes::room_with_box(), options);
  for (const unsigned threads : {1u, 2u, 5u}) {
    options.threads = threads;
    const Solution other = solved(scenes::room_with_box(), options);
    CHECK((other.radiosity == one.radiosity));
    CHECK(other.audit.rays == one.audit.rays);
    REQUIRE(other.audit.surface_error);
    CHECK(other.audit.surface_error->relative_l2 == one.audit.surface_error->relative_l2);
    REQUIRE(other.mesh.corners.size() == one.mesh.corners.size());
    for (std::size_t i = 0; i < one.mesh.corners.size(); ++i) { REQUIRE(other.mesh.corners[i].radiosity == one.mesh.corners[i].radiosity); }
  }
}

TEST_CASE("another seed gives another estimate of the same radiosity") {
  Options options = coarse();
  const Solution one = solved(scenes::room_with_box(), options);
  options.seed = 2;
  const Solution other = solved(scenes::room_with_box(), options);
  CHECK((one.radiosity != other.radiosity));
  CHECK(one.audit.surfaces[0].radiosity.x == test::Approx(other.audit.surfaces[0].radiosity.x).epsilon(0.02));
}

TEST_CASE("a room that emits on one wall: the solution converges to the finite-element value", "[accuracy]") {
  // Unit cube, rho .5, floor emits 1: mean of each side wall .181105558, of the ceiling between them (reference data, 1e-6).
  Scene scene;
  scene.materials = {{"wall", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.5}, radiosity::Color{1.0}}};
  scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, {1, 1, 1}), 0, true)};
  scene.objects[0].material = {0, 0, 0, 0, 1, 0};  // x0 x1 y0 y1 z0 z1
  for (const double epsilon : {0.1, 0.03, 0.01}) {
    Options options = coarse();
    options.epsilon = epsilon;
    options.min_area = 1e-3 * epsilon;
    const Solution solution = solved(scene, options);
    const double error = std::abs(solution.audit.surfaces[0].radiosity.x / 0.18110555822851843 - 1.0);
    CAPTURE(epsilon, error);
    CHECK(error < 0.05 * epsilon);
  }
}

TEST_CASE("no light: nothing is refined, linked or solved, and B = 0") {
  Scene scene = scenes::furnace_cube(0.5);
  scene.materials[0].emission = radiosity::Color{0.0};
  const Solution solution = solved(scene, coarse());
  CHECK(solution.audit.links == 0);
  CHECK(solution.audit.rays == 0);
  CHECK(solution.audit.nodes == 6);
  for (const auto& b : solution.radiosity) { CHECK(b == radiosity::Color{0.0}); }
}

TEST_CASE("all black: B = E without links") {
  Scene scene = scenes::furnace_cube(0.0);
  const Solution solution = solved(scene, coarse());
  CHECK(solution.audit.links == 0);
  for (const auto& b : solution.radiosity) { CHECK(b == radiosity::Color{1.0}); }
}

TEST_CASE("a closed scene of reflectance 1 with a light has no steady state and is refused") {
  Scene scene = scenes::furnace_cube(1.0);
  scene.materials[0].emission = radiosity::Color{1.0};
  const Outcome outcome = radiosity::solve(scene, coarse());
  CHECK_FALSE(outcome.solution);
  REQUIRE(outcome.failure.sentences.size() == 1);
  CHECK(outcome.failure.sentences[0].find("grow without end") != std::string::npos);
}

TEST_CASE("faulty scenes are refused with a sentence for every fault") {
  Scene scene = scenes::furnace_cube(0.5);
  scene.materials[0].reflectance.y = 1.5;
  scene.objects[0].material = {0, 0};
  scene.objects.push_back(scenes::object("flat", scenes::polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 7, true));
  const Outcome outcome = radiosity::solve(scene, coarse());
  CHECK_FALSE(outcome.solution);
  CHECK(outcome.failure.kind == radiosity::Failure::Kind::invalid_scene);
  CHECK(outcome.failure.sentences.size() == 4);  // reflectance, two materials for six sheets, no inside, no such material
}

TEST_CASE("a run that is cancelled before its first generation gives no solution") {
  const std::atomic<bool> cancel{true};
  radiosity::Control control;
  control.cancel = &cancel;
  const Outcome outcome = radiosity::solve(scenes::room_with_box(), coarse(), control);
  CHECK_FALSE(outcome.solution);
  CHECK(outcome.failure.kind == radiosity::Failure::Kind::cancelled);
}

TEST_CASE("a run that is cancelled while its links are solved ends with their solution, by conjugate gradients, and says so") {
  radiosity::Scene scene = scenes::room_with_box();
  for (radiosity::Material& material : scene.materials) { material.reflectance = radiosity::Color{1.0 - 1e-9}; }  // the others take hours
  radiosity::Options options{.epsilon = 0.2, .min_area = 0.01, .max_iterations = 4'000'000'000, .audit_points = 0};
  const radiosity::Outcome whole = radiosity::solve(scene, options);
  REQUIRE(whole.solution);
  for (const radiosity::Solver solver : {radiosity::Solver::jacobi, radiosity::Solver::gauss_seidel, radiosity::Solver::southwell}) {
    INFO(name(solver));
    options.solver = solver;
    std::atomic<bool> cancel{false};
    std::jthread later;
    radiosity::Control control;
    control.cancel = &cancel;
    control.progress = [&](std::string_view stage, double part) {
      if (stage != "link" || part < 1.0) { return; }
      later = std::jthread{[&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        cancel = true;
      }};
    };
    const radiosity::Outcome outcome = radiosity::solve(scene, options, control);
    REQUIRE(outcome.solution);
    CHECK(outcome.solution->audit.interrupted);
    CHECK_FALSE(outcome.solution->audit.converged);
    CHECK((outcome.solution->radiosity == whole.solution->radiosity));
  }
}

TEST_CASE("with a time limit the best so far is returned: a valid solution, with less estimated error for more time") {
  Options options{.refinement = radiosity::Refinement::a_posteriori, .audit_points = 0};
  double estimates[2] = {};
  for (int more = 0; more < 2; ++more) {
    options.time = more == 0 ? 1e-6 : 0.5;
    const Outcome outcome = radiosity::solve(scenes::room_with_box(), options);
    REQUIRE(outcome.solution);
    CHECK(outcome.solution->audit.converged);
    CHECK(outcome.solution->audit.energy_balance < 1e-6);
    REQUIRE(outcome.solution->audit.estimated_error);
    estimates[more] = *outcome.solution->audit.estimated_error;
  }
  CHECK(estimates[1] <= estimates[0]);

  options.refinement = radiosity::Refinement::a_priori;
  options.error = 0.02;
  CHECK(radiosity::solve(scenes::room_with_box(), options).failure.sentences.size() == 3);  // both limits, F-refinement, no audit
}
