// SPDX-License-Identifier: MIT

// The audit tells the truth: the path tracer is unbiased, the error estimate recovers errors that were put in, the plan
// leaves out only what it has a proof for.

#include <atomic>
#include <cmath>

#include <brep/circulators.hpp>
#include <brep/handles.hpp>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/audit/surface_error.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"

using radiosity::Options;
using radiosity::Scene;
using radiosity::Solution;

namespace {

radiosity::Prepared prepared(const Scene& scene) {
  auto result = radiosity::prepare(scene);
  REQUIRE(result.prepared);
  return std::move(*result.prepared);
}

// Mean and standard error of path-traced radiosity, first channel, over points spread over one sheet's faces.
std::pair<double, double> traced(const Scene& scene, std::uint32_t object, std::uint32_t sheet, int count, std::uint64_t seed) {
  const radiosity::Prepared p = prepared(scene);
  const radiosity::PathTracer tracer{scene, p.objects, p.surfaces};
  std::vector<radiosity::Patch> patches;
  double area = 0.0;
  for (const brep::FaceId f : brep::faces(p.surfaces[object].brep)) {
    if (p.surfaces[object].brep.data(f).sheet != sheet) { continue; }
    patches.push_back(radiosity::make_patch(radiosity::corner_polygon(p.surfaces[object].brep, f)));
    area += patches.back().area;
  }
  double sum = 0.0;
  double square = 0.0;
  std::uint64_t rays = 0;
  for (int i = 0; i < count; ++i) {
    radiosity::Random random{seed, static_cast<std::uint64_t>(i)};
    double rest = random.uniform() * area;
    std::size_t k = 0;
    while (k + 1 < patches.size() && rest > patches[k].area) { rest -= patches[k++].area; }
    const double u = random.uniform();
    const auto point = p.objects.object(object).project(sheet, radiosity::sample(patches[k], u, random.uniform()));
    const double b = tracer.radiosity({point, object, sheet}, random, rays).all.x;
    sum += b;
    square += b * b;
  }
  const double mean = sum / count;
  return {mean, std::sqrt((square / count - mean * mean) / count)};
}

}  // namespace

TEST_CASE("path tracing is unbiased: furnaces glow at 1, an emitting wall lights its neighbours as the reference says") {
  INFO("seed 5");
  const auto check = [](std::pair<double, double> estimate, double expected) {
    CAPTURE(estimate.first, estimate.second, expected);
    CHECK(std::abs(estimate.first - expected) < 4.0 * estimate.second + 1e-12);  // a false alarm in 16 000
  };
  check(traced(scenes::furnace_with_things(0.8), 0, 4, 20000, 5), 1.0);  // floor
  check(traced(scenes::furnace_with_things(0.8), 2, 0, 20000, 5), 1.0);  // sphere
  check(traced(scenes::furnace_sphere(0.9), 0, 0, 20000, 5), 1.0);

  Scene wall = scenes::furnace_cube(0.5);  // the floor emits, the rest reflects one half; finite-element reference
  wall.materials = {{"wall", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.5}, radiosity::Color{1.0}}};
  wall.objects[0].material = {0, 0, 0, 0, 1, 0};
  check(traced(wall, 0, 0, 100000, 5), 0.18110555822851843);
}

TEST_CASE("path tracing agrees with the solution of a room with a box and a lamp", "[accuracy]") {
  const Scene scene = scenes::room_with_box();
  const Options options{.audit_points = 0};
  const auto outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  const auto [mean, error] = traced(scene, 0, 0, 100000, 9);  // wall x0
  CAPTURE(mean, error);
  CHECK(std::abs(outcome.solution->audit.surfaces[0].radiosity.x - mean) < 4.0 * error + 0.01 * mean);
}

TEST_CASE("a solution that is 5 % too bright is found to be 5 % too bright") {
  const Scene scene = scenes::furnace_with_things(0.5);
  radiosity::DiscreteScene p{scene, 1, 1};
  p.take(prepared(scene));
  const Options options{.epsilon = 0.02, .min_area = 1e-4, .audit_points = 0};
  auto outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  REQUIRE(outcome.solution->audit.closure);  // so B = 1 exactly
  radiosity::Mesh mesh = outcome.solution->mesh;
  for (auto& x : mesh.positions) { x = (x - p.frame.centre) * p.frame.scale; }
  for (auto& corner : mesh.corners) { corner.radiosity *= 1.05; }
  p.exposure.partly_buried.assign(outcome.solution->hierarchy.size(), true);
  p.exposure.area = outcome.solution->area;
  const radiosity::PathTracer tracer{scene, p.objects, p.surfaces};
  radiosity::SurfaceErrorMeter meter{p, tracer, mesh, nullptr, 1};
  radiosity::SurfaceError measured;
  REQUIRE(meter.measure(1000, 64, 2, {}, measured));
  REQUIRE(meter.measure(1000, 64, 2, {}, measured));
  CHECK(measured.points() > 1900);  // but for buried ones
  const auto reconstructed = measured.reconstructed.estimate();
  REQUIRE(reconstructed);
  // Reflected radiosity is 0.5, so an error of 0.05 is 10 % of it.
  CAPTURE(reconstructed->relative_l2, reconstructed->standard_error);
  CHECK(std::abs(reconstructed->relative_l2 - 0.1) < 4.0 * reconstructed->standard_error);
  CHECK(measured.leaf.estimate()->relative_l2 < 0.05);
}

TEST_CASE("an audit of a target decides from fresh points, or ends at its rays") {
  // Points of one radiosity, off by twice what is wanted or by none of it, seen through a noise of ten times that.
  struct Points {
    radiosity::ErrorSums sums;
    std::uint64_t rays = 0;
  };
  for (const double off : {0.0, 0.04}) {
    std::uint64_t asked = 0;
    const auto measure = [&](std::uint64_t points, std::uint32_t paths, Points& to) {
      for (std::uint64_t i = 0; i < points; ++i) {
        radiosity::Random random{7, asked++};
        const double spread = 0.2 / std::sqrt(paths);
        const double a = spread * (random.uniform() - 0.5), b = spread * (random.uniform() - 0.5);
        to.sums.add((off + a) * (off + b), 1.0, std::pow(0.5 * (a - b) * (a - b), 2) / 3.0);
      }
      to.rays += points * paths;
      return true;
    };
    Points measured;
    REQUIRE(radiosity::measure_to_goal<Points>(
        measure, [](const Points& p) -> const radiosity::ErrorSums& { return p.sums; }, {400, 1'000'000, 0.02, 1'000'000}, measured));
    CAPTURE(off, measured.sums.square.size(), measured.rays);
    REQUIRE(measured.sums.estimate());
    CHECK(measured.sums.estimate()->within(0.02) == (off == 0.0));
    CHECK(measured.sums.square.size() < asked);  // the pilot's points are not among them
    CHECK(measured.rays <= 1'000'000);
  }
}

TEST_CASE("an audit costs what it may: as much as the solution, more only to show the wanted error, and then no more than that takes") {
  // Points whose errors and noise are random, from 1e-4 to 1e-1; a path is a ray.
  struct Points {
    radiosity::ErrorSums sums;
    std::uint64_t rays = 0;
  };
  INFO("seed 17");
  radiosity::Random random{17, 0};
  for (int round = 0; round < 60; ++round) {
    const double off = round % 4 == 0 ? 0.0 : std::pow(10.0, -4.0 + 3.0 * random.uniform());
    const double spread = std::pow(10.0, -3.0 + 2.5 * random.uniform());  // of one path
    const double wanted = std::pow(10.0, -2.5 + 1.5 * random.uniform());
    const auto budget = static_cast<std::uint64_t>(std::pow(10.0, 3.0 + 3.0 * random.uniform()));
    constexpr std::uint64_t to_show = 50'000'000, points_wanted = 400, least = points_wanted / 4;
    std::uint64_t asked = 0, rays = 0;
    const auto measure = [&](std::uint64_t points, std::uint32_t paths, Points& to) {
      for (std::uint64_t i = 0; i < points; ++i) {
        radiosity::Random at{7, asked++};
        const double error = off * std::sqrt(2.0 * at.uniform()), noise = spread / std::sqrt(paths);
        const double a = noise * (at.uniform() - 0.5), b = noise * (at.uniform() - 0.5);
        to.sums.add((error + a) * (error + b), 1.0, std::pow(0.5 * (a - b) * (a - b), 2) / 3.0);
      }
      to.rays += points * paths;
      rays += points * paths;
      return true;
    };
    Points measured;
    REQUIRE(radiosity::measure_to_goal<Points>(
        measure, [](const Points& p) -> const radiosity::ErrorSums& { return p.sums; }, {points_wanted, budget, wanted, to_show},
        measured));
    CAPTURE(round, off, spread, wanted, budget, rays, measured.sums.square.size());
    // The pilots, each four times the one before it and half of the least that is measured, are a third of that more.
    const std::uint64_t floor = 3 * 16 * least;
    const auto most = static_cast<double>(std::max(floor, 2 * budget));
    if (off > 2.0 * wanted) { CHECK(static_cast<double>(rays) <= most); }
    if (off < 0.5 * wanted) {
      // To know the mean square to a quarter of the target takes n points of p paths, 16 (spread^2 / (12 p))^2 / n of noise. The cheapest
      // p gives the least number of points, or is the fewest.
      const double noise = spread * spread / 12.0, square = wanted * wanted;
      const double paths = std::max(4.0, 4.0 * noise / (square * std::sqrt(static_cast<double>(least))));
      const double enough = static_cast<double>(least) * paths;
      CHECK(static_cast<double>(rays) <= std::max(most, 64.0 * enough));
    }
    CHECK(rays <= 2 * to_show);
  }
}

TEST_CASE("a run with an accuracy target ends when it is cancelled while its audit is undecided") {
  std::atomic<bool> cancel{false};
  radiosity::Control control;
  control.cancel = &cancel;
  control.progress = [&](std::string_view stage, double) { cancel = cancel || stage == "audit"; };
  const Options options{.error = 0.02};
  const auto outcome = radiosity::solve(scenes::two_plates(0.5), options, control);
  REQUIRE(outcome.solution);
  CHECK(outcome.solution->audit.interrupted);
  CHECK_FALSE(outcome.solution->audit.surface_error);
}

TEST_CASE("plan: a lamp flush with the ceiling of a room leaves it closed, a lamp below it does not") {
  CHECK(prepared(scenes::room_with_box()).plan.closed);
  Scene lowered = scenes::room_with_box();
  lowered.objects[2].placement.translation.z = -0.1;
  CHECK_FALSE(prepared(lowered).plan.closed);
  CHECK_FALSE(prepared(scenes::two_plates(0.5)).plan.closed);
}

TEST_CASE("plan: what cannot occlude is left out, what can is kept") {
  const auto occluders = [](const Scene& scene) { return prepared(scene).plan.occluders; };
  CHECK(occluders(scenes::furnace_cube(0.5)) == 0);
  CHECK(occluders(scenes::two_plates(0.5)) == 0);
  CHECK(occluders(scenes::room_with_box()) == 1);  // the box; not the lamp in the ceiling
  CHECK(occluders(scenes::furnace_with_things(0.5)) == 3);
  Scene between = scenes::two_plates(0.5);
  between.objects.push_back(scenes::object("blocker", scenes::polygon({{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}}), 1));
  CHECK(occluders(between) == 1);
}

TEST_CASE("a plate between two plates stops all light between them") {
  Scene scene = scenes::two_plates(0.5);
  scene.objects.push_back(scenes::object("blocker", scenes::polygon({{-3, -3, 0.5}, {-3, 3, 0.5}, {3, 3, 0.5}, {3, -3, 0.5}}), 1));
  Options options{.audit_points = 0};
  const auto outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  CHECK(outcome.solution->audit.surfaces[1].radiosity == radiosity::Color{0.0});  // the upper plate
  CHECK(outcome.solution->audit.surfaces[2].radiosity.x > 0.01);                  // the blocker, lit from below on 1/36 of its area
}

TEST_CASE("ground under a box is buried: it takes no part, and the ground beside it keeps its brightness") {
  Options options{.audit_points = 0};
  const auto outcome = radiosity::solve(scenes::room_with_box(), options);
  REQUIRE(outcome.solution);
  const Solution& solution = *outcome.solution;
  double floor_area = 0.0;
  for (const auto& mean : solution.audit.surfaces) {
    if (mean.name == "room.z0") { floor_area = mean.area; }
    if (mean.name == "box.z0") { CHECK(mean.area == 0.0); }
  }
  // 1 - 0.09 exposed. Sampling error: 1/32 of a leaf at each of the leaves along the outline of the box.
  CHECK(floor_area == test::Approx(0.91).margin(2e-3));
}

TEST_CASE("an error target is met, and a tighter one takes more links", "[slow]") {
  std::uint64_t links = 0;
  for (const double target : {0.1, 0.01}) {
    const Options options{.error = target};
    const auto outcome = radiosity::solve(scenes::room_with_box(), options);
    REQUIRE(outcome.solution);
    const radiosity::Audit& audit = outcome.solution->audit;
    CHECK(audit.converged);
    REQUIRE(audit.surface_error);
    CHECK(audit.surface_error->high <= target);
    CHECK(audit.links > links);
    links = audit.links;
  }
  const Options blind{.error = 0.1, .audit_points = 0};
  CHECK_FALSE(radiosity::solve(scenes::room_with_box(), blind).solution);
}

TEST_CASE("row sums of an open scene are those of what is exposed: leaves under a box on a plate have none and do not count") {
  // Every exposed face of plate and box sees one of the two large lamps, in part or whole.
  Scene scene{{{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}}, {}};
  scene.objects = {scenes::object("plate", scenes::box({-1, -1, -0.5}, {1, 1, 0})),
                   scenes::object("box", scenes::box({-0.55, -0.55, 0}, {0.55, 0.55, 1})),
                   scenes::square("above", {0, 0, 3}, 6.0, false, 1), scenes::square("below", {0, 0, -3}, 6.0, true, 1)};
  const Options options{.min_area = 7.5e-6, .audit_points = 0};
  const radiosity::Outcome outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  const Solution& solution = *outcome.solution;
  int buried = 0;
  double least = 1.0;
  for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
    if (!solution.hierarchy[i].leaf()) { continue; }
    if (solution.area[i] > 0.0) { least = std::min(least, solution.row_sum[i]); }
    if (solution.area[i] > 0.0) { continue; }
    ++buried;
    CHECK(solution.row_sum[i] == 0.0);
  }
  CHECK(buried > 100);
  CHECK(least > 0.0);
  CHECK(solution.audit.row_sum.min == least);
  CHECK(solution.audit.row_sum.max <= 1.05);
  for (const radiosity::SurfaceMean& surface : solution.audit.surfaces) {
    if (surface.name == "box.z0") { CHECK(surface.area == 0.0); }
    if (surface.name == "plate.z1") { CHECK(surface.area == test::Approx(4.0 - 1.21).epsilon(0.01)); }
  }
}
