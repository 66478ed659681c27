// SPDX-License-Identifier: MIT

// F-refinement that is told to stop at any moment: nothing before its first generation, else a solution of the scene, coarse but whole.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "many_scene.hpp"
#include "scenes.hpp"
#include "solved.hpp"

using radiosity::Options;
using radiosity::Outcome;
using radiosity::Scene;
using radiosity::Solution;

namespace {

Options finely() { return {.epsilon = 0.02, .min_area = 9.6e-4, .audit_points = 0}; }

// What the run tells of its progress, call by call.
std::vector<std::string> steps_of(const Scene& scene, const Options& options) {
  std::vector<std::string> steps;
  radiosity::Control control;
  control.progress = [&](std::string_view stage, double) { steps.emplace_back(stage); };
  (void)scenes::solved(scene, options, control);
  return steps;
}

// The run is told to stop in that call.
Outcome stopped_at(std::size_t step, const Scene& scene, const Options& options) {
  std::atomic<bool> cancel{false};
  std::size_t calls = 0;
  radiosity::Control control;
  control.cancel = &cancel;
  control.progress = [&](std::string_view, double) { cancel = calls++ >= step; };
  return radiosity::solve(scene, options, control);
}

// No light is made or lost, and none is negative. `brightest`: no radiosity can be above that.
void check_whole(const Solution& solution, double brightest) {
  CHECK(solution.audit.energy_balance < 1e-6);
  CHECK(solution.audit.residual <= 1e-8);
  CHECK(solution.links.size() + solution.ray_links.size() > 0);
  const auto possible = [&](const radiosity::Color& b) {
    return b.x >= 0.0 && b.x <= brightest && std::isfinite(b.y) && std::isfinite(b.z);
  };
  CHECK(std::all_of(solution.radiosity.begin(), solution.radiosity.end(), possible));
  CHECK(std::all_of(solution.mesh.faces.begin(), solution.mesh.faces.end(), [&](const auto& face) { return possible(face.radiosity); }));
  CHECK(std::all_of(solution.mesh.corners.begin(), solution.mesh.corners.end(), [](const auto& c) { return c.radiosity.x >= 0.0; }));
}

double mean_of(const Solution& solution) {
  double light = 0.0, area = 0.0;
  for (const radiosity::SurfaceMean& surface : solution.audit.surfaces) {
    light += surface.area * surface.radiosity.x;
    area += surface.area;
  }
  return light / area;
}

struct Stopped {
  const char* name;
  Scene scene;
  Options options;
  double brightest;  // the highest emission over 1 - reflectance
};

std::vector<Stopped> stopped_scenes() {
  std::vector<Stopped> all;
  all.push_back({"closed room", scenes::room_with_box(), finely(), 5.0 / 0.3});
  all.push_back({"open", scenes::two_plates(0.5), finely(), 2.0});
  all.push_back({"curved", scenes::furnace_with_things(0.5), finely(), 1.0 + 1e-6});
  Stopped clustered{"clusters", scenes::room_with_box(), finely(), 5.0 / 0.3};
  clustered.options.cluster_from = 1;
  clustered.options.indirect = radiosity::Indirect::links;
  all.push_back(clustered);
  Stopped rays{"stored rays", scenes::room_with_box(), finely(), 5.0 / 0.3};
  rays.options.indirect = radiosity::Indirect::rays;
  all.push_back(rays);
  Stopped cut{"edges of shadows", scenes::room_with_box(), finely(), 5.0 / 0.3};
  cut.options.discontinuities = 1000;
  all.push_back(cut);
  Stopped separate{"separate polygons", scenes::room_with_box(), finely(), 5.0 / 0.3};
  separate.options.topology = radiosity::Topology::separate;
  all.push_back(separate);
  return all;
}

}  // namespace

TEST_CASE("F-refinement that is stopped at any step gives a whole solution that says so, or none before its first generation") {
  const std::uint32_t seed = 5;
  CAPTURE(seed);
  std::mt19937 random{seed};
  for (const Stopped& of : stopped_scenes()) {
    INFO(of.name);
    const Solution whole = scenes::solved(of.scene, of.options);
    Options coarse = of.options;
    coarse.epsilon = 0.04;
    coarse.min_area = 3.84e-3;
    const Solution coarser = scenes::solved(of.scene, coarse);
    const std::vector<std::string> steps = steps_of(of.scene, of.options);
    const auto first = static_cast<std::size_t>(std::find(steps.begin(), steps.end(), "refine") - steps.begin());
    REQUIRE(first < steps.size());
    const double mean = mean_of(whole);
    for (int i = 0; i < 5; ++i) {
      const std::size_t step = i == 0 ? first : random() % steps.size();
      CAPTURE(step, steps[step], first, steps.size());
      const Outcome outcome = stopped_at(step, of.scene, of.options);
      if (!outcome.solution) {
        CHECK(step < first);
        CHECK(outcome.failure.kind == radiosity::Failure::Kind::cancelled);
        continue;
      }
      const radiosity::Audit& audit = outcome.solution->audit;
      check_whole(*outcome.solution, of.brightest);
      CHECK(audit.interrupted);
      CHECK_FALSE(audit.converged);
      // Its links cover what those of a run with its thresholds cover: by their sums, before these are put right.
      const Solution& alike = audit.coarsened ? coarser : whole;
      CHECK(audit.epsilon == (audit.coarsened ? 0.04 : of.options.epsilon));
      CHECK(audit.computed_row_sum.mean == test::Approx(alike.audit.computed_row_sum.mean).epsilon(0.02));
      CHECK(mean_of(*outcome.solution) == test::Approx(mean).epsilon(0.03));
    }
  }
}

TEST_CASE("what a stopped run gives does not depend on threads, where it is stopped in a call of its own") {
  const std::uint32_t seed = 6;
  CAPTURE(seed);
  std::mt19937 random{seed};
  for (const Stopped& of : stopped_scenes()) {
    INFO(of.name);
    const std::vector<std::string> steps = steps_of(of.scene, of.options);
    for (int i = 0; i < 2; ++i) {
      const std::size_t step = random() % steps.size();
      CAPTURE(step, steps[step]);
      Options options = of.options;
      options.threads = 1;
      const Outcome one = stopped_at(step, of.scene, options);
      options.threads = 3;
      const Outcome three = stopped_at(step, of.scene, options);
      REQUIRE(one.solution.has_value() == three.solution.has_value());
      if (!one.solution) { continue; }
      CHECK(one.solution->audit.coarsened == three.solution->audit.coarsened);
      CHECK(one.solution->radiosity == three.solution->radiosity);
    }
  }
}

TEST_CASE("stopped from another thread, a run gives a whole solution soon, of fewer links and with no audit") {
  const std::uint32_t seed = 7;
  CAPTURE(seed);
  std::mt19937 random{seed};
  const Scene scene = scenes::many(150, scenes::Things::boxes);
  Options options = finely();
  options.audit_points = 2000;
  for (int i = 0; i < 4; ++i) {
    std::atomic<bool> cancel{false};
    std::jthread later;
    const std::chrono::microseconds wait{random() % 400'000};
    radiosity::Control control;
    control.cancel = &cancel;
    bool begun = false;
    control.progress = [&](std::string_view stage, double) {
      if (begun || stage != "refine") { return; }
      begun = true;
      later = std::jthread{[&] {
        std::this_thread::sleep_for(wait);
        cancel = true;
      }};
    };
    const Outcome outcome = radiosity::solve(scene, options, control);
    REQUIRE(outcome.solution);
    const radiosity::Audit& audit = outcome.solution->audit;
    CAPTURE(wait.count(), audit.coarsened);
    check_whole(*outcome.solution, 1e3);
    if (!audit.interrupted) { continue; }
    CHECK_FALSE(audit.leaf_error);
    CHECK(std::any_of(audit.left_out.begin(), audit.left_out.end(), [](const auto& out) { return out.what == "the error estimate"; }));
  }
}

TEST_CASE("an error target that is stopped in its second round gives the solution of the first and says so") {
  const Options options{.error = 0.001, .audit_points = 50};
  for (const char* last : {"refine", "link"}) {
    std::atomic<bool> cancel{false};
    bool audited = false;
    radiosity::Control control;
    control.cancel = &cancel;
    control.progress = [&](std::string_view stage, double) {
      audited = audited || stage == "audit";
      cancel = cancel || (audited && stage == last);
    };
    const Outcome outcome = radiosity::solve(scenes::two_plates(0.5), options, control);
    REQUIRE(outcome.solution);
    CHECK(outcome.solution->audit.interrupted);
    CHECK_FALSE(outcome.solution->audit.coarsened);
    CHECK_FALSE(outcome.solution->audit.converged);
    CHECK(outcome.solution->audit.surface_error);
  }
}
