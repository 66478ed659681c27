// SPDX-License-Identifier: MIT

// The limit on memory: what a run holds at its peak, by the heap's own count, never exceeds it, and it costs nothing where there is enough.

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/run/uniform.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/memory.hpp>

#include "apps/stress/scenes.hpp"

#include "catch.hpp"
#include "heap.hpp"

using radiosity::Failure;
using radiosity::Options;
using radiosity::Outcome;

namespace {

struct Measured {
  Outcome outcome;
  std::uint64_t peak = 0;
};

template <class Solve>
Measured measured(const Solve& solve) {
  const std::int64_t before = heap::live_bytes();
  heap::reset_peak();
  Measured result{solve(), 0};
  result.peak = static_cast<std::uint64_t>(heap::peak_bytes() - before);
  return result;
}

// Limits from far too small to more than enough.
std::vector<std::uint64_t> limits() {
  std::vector<std::uint64_t> result;
  for (double bytes = 3e5; bytes < 1.2e8; bytes *= 1.6) { result.push_back(static_cast<std::uint64_t>(bytes)); }
  return result;
}

// What the scene itself takes, which is there before anything is counted: the peak of a run that may take nodes for its surfaces, no more.
std::uint64_t peak_of_scene(const radiosity::Scene& scene, Options options) {
  options.memory = radiosity::MemoryBudget{}.peak({radiosity::surfaces(scene).size()});
  const Measured none = measured([&] { return radiosity::solve(scene, options); });
  CHECK_FALSE(none.outcome.solution);
  return none.peak;
}

// A limit with which the run ends with coarser thresholds: between one that refuses it and one that suffices. 0 if none is found.
std::uint64_t limit_that_coarsens(const radiosity::Scene& scene, Options options, std::uint64_t refuses, std::uint64_t suffices) {
  while (suffices - refuses > 1) {
    const std::uint64_t middle = refuses + (suffices - refuses) / 2;
    options.memory = middle;
    const Outcome outcome = radiosity::solve(scene, options);
    if (outcome.solution && outcome.solution->audit.coarsened) { return middle; }
    (outcome.solution ? suffices : refuses) = middle;
  }
  return 0;
}

}  // namespace

TEST_CASE("memory limit of F-refinement: the best that fits, finer with more memory, never exceeded") {
  const std::uint32_t seed = 8;
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  const std::vector<radiosity::Scene> scenes{apps::stress::room_with_box(), apps::stress::furnace_with_things(0.5)};
  for (const radiosity::Scene& scene : scenes) {
    Options options{.epsilon = 0.05, .min_area = 4e-3, .audit_points = 0, .threads = 1};
    const Measured whole = measured([&] { return radiosity::solve(scene, options); });
    REQUIRE(whole.outcome.solution);
    const std::uint64_t of_scene = peak_of_scene(scene, options);
    std::vector<std::uint64_t> all = limits();
    all.push_back(10'000);     // less than its patches take
    all.push_back(1'090'000);  // where tables of few rows once took .4 % more
    for (int i = 0; i < 10; ++i) { all.push_back(of_scene / 2 + random() % (3 * whole.peak)); }
    all.push_back(limit_that_coarsens(scene, options, of_scene / 2, 3 * whole.peak));
    for (int i = 0; i < 16; ++i) { all.push_back(of_scene + random() % (2 * whole.peak - of_scene)); }
    std::sort(all.begin(), all.end());
    REQUIRE(all[0] > 0);
    bool refused = false, coarsened = false;
    double epsilon = 2.0;
    for (const std::uint64_t limit : all) {
      CAPTURE(limit, whole.peak, of_scene);
      options.memory = limit;
      const Measured run = measured([&] { return radiosity::solve(scene, options); });
      CHECK(run.peak <= std::max(limit, of_scene + 1000));  // and a sentence
      if (!run.outcome.solution) {
        CHECK(epsilon == 2.0);  // more memory never does harm
        CHECK(run.outcome.failure.kind == Failure::Kind::out_of_memory);
        refused = true;
        continue;
      }
      const radiosity::Solution& solution = *run.outcome.solution;
      CHECK(solution.audit.epsilon <= epsilon);
      epsilon = solution.audit.epsilon;
      CHECK(solution.audit.shortage.empty() == (epsilon == options.epsilon));
      CHECK(solution.audit.coarsened != solution.audit.shortage.empty());
      CHECK(solution.audit.converged == solution.audit.shortage.empty());
      CHECK(solution.audit.energy_balance < 1e-6);
      coarsened = coarsened || solution.audit.coarsened;
      if (solution.audit.shortage.empty()) {
        CHECK(solution.radiosity == whole.outcome.solution->radiosity);
      } else {
        CHECK(limit < 3 * whole.peak);  // what suffices three times over is enough
        Options asked = options;        // it is the solution with these thresholds
        asked.memory.reset();
        asked.epsilon = solution.audit.epsilon;
        asked.min_area = solution.audit.min_area;
        CHECK(radiosity::solve(scene, asked).solution->radiosity == solution.radiosity);
      }
    }
    CHECK(refused);
    CHECK(coarsened);
    CHECK(epsilon == options.epsilon);
  }
}

TEST_CASE("memory limit of stored rays: coarser, and the same bits for any number of threads") {
  Options options{.epsilon = 0.02, .min_area = 1e-3, .indirect = radiosity::Indirect::rays, .audit_points = 0, .threads = 1};
  const radiosity::Scene scene = apps::stress::room_with_box();
  const Measured whole = measured([&] { return radiosity::solve(scene, options); });
  REQUIRE(whole.outcome.solution);
  options.memory = whole.peak / 4;
  const Measured one = measured([&] { return radiosity::solve(scene, options); });
  REQUIRE(one.outcome.solution);
  CHECK(one.peak <= *options.memory);
  CHECK_FALSE(one.outcome.solution->audit.shortage.empty());
  CHECK(one.outcome.solution->audit.stored_rays > 0);
  CHECK(one.outcome.solution->audit.epsilon > options.epsilon);
  options.threads = 3;
  CHECK(radiosity::solve(scene, options).solution->radiosity == one.outcome.solution->radiosity);
}

TEST_CASE("memory limit of BF-refinement: the best that fits, finer with more memory, never exceeded") {
  Options options{.refinement = radiosity::Refinement::a_posteriori, .target = 0.03, .audit_points = 0, .threads = 1};
  const radiosity::Scene scene = apps::stress::room_with_box();
  const std::uint64_t of_scene = peak_of_scene(scene, options);
  double estimate = 1e9;
  bool ended_early = false, met = false;
  for (const std::uint64_t limit : limits()) {
    CAPTURE(limit);
    options.memory = limit;
    const Measured run = measured([&] { return radiosity::solve(scene, options); });
    CHECK(run.peak <= std::max(limit, of_scene + 1000));  // and a sentence
    if (!run.outcome.solution) {
      CHECK(run.outcome.failure.kind == Failure::Kind::out_of_memory);
      CHECK(estimate == 1e9);
      continue;
    }
    const radiosity::Audit& audit = run.outcome.solution->audit;
    CHECK(audit.converged == audit.shortage.empty());
    CHECK((audit.shortage.empty() || *audit.estimated_error > options.target));
    CHECK(*audit.estimated_error <= 1.25 * estimate);  // of other links, so not quite in order
    estimate = *audit.estimated_error;
    ended_early = ended_early || !audit.shortage.empty();
    met = met || audit.converged;
    if (audit.converged) { break; }
  }
  CHECK(ended_early);
  CHECK(met);
}

TEST_CASE("memory limit of an error target: the round before, and it says so") {
  const Options options{.error = 0.002, .audit_points = 100, .threads = 1, .memory = 3'000'000};
  const Measured run = measured([&] { return radiosity::solve(apps::stress::two_plates(0.5), options); });
  REQUIRE(run.outcome.solution);
  CHECK(run.peak <= *options.memory);
  CHECK_FALSE(run.outcome.solution->audit.shortage.empty());
  CHECK_FALSE(run.outcome.solution->audit.converged);
  CHECK(run.outcome.solution->audit.target_missed);
  CHECK(run.outcome.solution->audit.rounds_ended_by == "want of memory");
}

TEST_CASE("memory limit of a run towards an accuracy: 2 GB if none is set") {
  Options options{.refinement = radiosity::Refinement::a_posteriori, .target = 0.02};
  CHECK(options.allowed_memory() == 2'000'000'000u);
  options.time = 5.0;
  CHECK_FALSE(options.allowed_memory());
  options = {.refinement = radiosity::Refinement::a_priori};
  CHECK_FALSE(options.allowed_memory());
  options.error = 0.02;
  CHECK(options.allowed_memory() == 2'000'000'000u);
  options.memory = 3'000'000;
  CHECK(options.allowed_memory() == 3'000'000u);
}

TEST_CASE("memory limit of a dense matrix: refused before it is made") {
  radiosity::UniformOptions options;
  options.max_area = 1.0 / 1500.0;
  options.threads = 1;
  options.memory = 6'000'000;  // the matrix of 1500 leaves takes 9
  const Measured run = measured([&] { return radiosity::solve_uniform(apps::stress::room_with_box(), options); });
  CHECK(run.outcome.failure.kind == Failure::Kind::out_of_memory);
  CHECK(run.peak <= *options.memory);
}

TEST_CASE("memory limit that the input surfaces alone exceed: refused before the scene is compiled") {
  radiosity::Scene scene = apps::stress::room_with_box();
  while (scene.objects.size() < 5000) { scene.objects.push_back(scene.objects.back()); }
  Options options;
  for (const std::uint64_t limit : {std::uint64_t{1}, std::uint64_t{1'000'000}, std::uint64_t{10'000'000}}) {
    options.memory = limit;
    const Measured run = measured([&] { return radiosity::solve(scene, options); });
    CAPTURE(limit, run.peak);
    CHECK(run.outcome.failure.kind == Failure::Kind::out_of_memory);
    CHECK(run.peak <=
          std::max(limit, 400 * std::uint64_t{scene.objects.size()}));  // to look at the scene itself takes some 200 bytes an object
  }
}

TEST_CASE("the peak of each stage is told, and grows from stage to stage") {
  const Options options{.epsilon = 0.2, .min_area = 0.01, .audit_points = 0};
  const Outcome outcome = radiosity::solve(apps::stress::room_with_box(), options);
  REQUIRE(outcome.solution);
  if (!radiosity::peak_memory()) { return; }
  std::uint64_t before = 1 << 20;  // no process is smaller
  for (const radiosity::StageTime& stage : outcome.solution->audit.stages) {
    REQUIRE(stage.peak_bytes);
    CHECK(*stage.peak_bytes >= before);
    before = *stage.peak_bytes;
  }
}
