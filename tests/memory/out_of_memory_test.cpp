// SPDX-License-Identifier: MIT

// Memory that runs out, and threads that cannot be started: solve() refuses, or its answer is right, and it gives back what it took.

#include <atomic>
#include <cstdint>
#include <random>
#include <vector>

#include <pthread.h>

#include <radiosity/bake/halflight.h>
#include <radiosity/bake/bake.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/parallel.hpp>

#include "apps/stress/scenes.hpp"

#include "catch.hpp"
#include "heap.hpp"

using radiosity::Failure;
using radiosity::Options;
using radiosity::Outcome;

namespace {

Options small() { return {.epsilon = 0.2, .min_area = 0.01, .audit_points = 8, .threads = 3}; }

Options bf() {
  Options options = small();
  options.refinement = radiosity::Refinement::a_posteriori;
  options.target = 0.2;
  options.audit_points = 0;
  return options;
}

// A refusal that says why, the whole answer, or a coarser one that says so.
void check_outcome(const Outcome& outcome, const Outcome& whole) {
  if (!outcome.solution) {
    CHECK(outcome.failure.kind == Failure::Kind::out_of_memory);
    CHECK_FALSE(outcome.failure.sentences.empty());
  } else if (outcome.solution->audit.shortage.empty()) {
    CHECK(outcome.solution->radiosity == whole.solution->radiosity);  // bit by bit
  } else {
    CHECK_FALSE(outcome.solution->audit.converged);
    CHECK(outcome.solution->audit.nodes <= whole.solution->audit.nodes);
    for (const radiosity::Color& b : outcome.solution->radiosity) { CHECK((b.x >= 0.0 && b.x < 1e3)); }
  }
}

// Lets one allocation fail after the other: the 1st, 2nd, 4th, 8th ... and as many counted from the last one, and some at random.
template <class Check>
void for_failing_allocations(std::uint64_t count, std::uint32_t seed, const Check& check) {
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  std::vector<std::uint64_t> which;
  for (std::uint64_t n = 1; n <= count; n *= 2) { which.insert(which.end(), {n, count + 1 - n}); }
  for (int i = 0; i < 20; ++i) { which.push_back(1 + random() % count); }
  for (const std::uint64_t n : which) {
    CAPTURE(n, count);
    check(n);
  }
}

void check_all_failures(const radiosity::Scene& scene, const Options& options, std::uint32_t seed) {
  const Outcome whole = radiosity::solve(scene, options);
  REQUIRE(whole.solution);
  const std::uint64_t before = heap::allocations();
  (void)radiosity::solve(scene, options);
  const std::uint64_t count = heap::allocations() - before;
  int refused = 0, coarser = 0;
  for_failing_allocations(count, seed, [&](std::uint64_t n) {
    const std::int64_t live = heap::live();
    {
      Outcome outcome;
      {
        const heap::Failure failure{n, heap::Fails::once};
        outcome = radiosity::solve(scene, options);
      }
      check_outcome(outcome, whole);
      refused += outcome.solution ? 0 : 1;
      coarser += outcome.solution && !outcome.solution->audit.shortage.empty() ? 1 : 0;
    }
    CHECK(heap::live() == live);  // nothing is lost
    {
      Outcome outcome;
      {
        const heap::Failure failure{n, heap::Fails::from_then_on};
        outcome = radiosity::solve(scene, options);
      }
      CHECK((outcome.solution || outcome.failure.kind == Failure::Kind::out_of_memory));  // there may be no memory for a sentence
    }
    CHECK(heap::live() == live);
  });
  CHECK(refused > 0);
  CHECK(coarser > 0);
}

}  // namespace

TEST_CASE("whichever allocation fails, light that is baked is there, or refused, and nothing is thrown") {
  const std::vector<radiosity::Material> materials{
      {"a name that is too long to stand in a string itself", radiosity::Color(0.5), radiosity::Color(1.0)}};
  const std::vector<float> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<std::uint32_t> indices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, material{0, 0, 0, 0};
  radiosity::BakeOptions options;
  options.solve = small();
  const radiosity::MeshView mesh{xyz, indices, materials, material};
  const std::uint64_t before = heap::allocations();
  REQUIRE(radiosity::bake(mesh, options).baked);
  const std::uint64_t count = heap::allocations() - before;
  int refused = 0;
  const auto check = [&](std::uint64_t n) {
    const std::int64_t live = heap::live();
    {
      radiosity::BakeOutcome outcome;
      {
        const heap::Failure failure{n, heap::Fails::once};
        CHECK_NOTHROW(outcome = radiosity::bake(mesh, options));
      }
      CHECK((outcome.baked || outcome.failure.kind == Failure::Kind::out_of_memory));
      refused += outcome.baked ? 0 : 1;
    }
    CHECK(heap::live() == live);
  };
  for (std::uint64_t n = 1; n <= 16; ++n) { check(n); }
  for_failing_allocations(count, 5, check);
  CHECK(refused > 16);
}

TEST_CASE("whichever allocation fails, the C interface returns a status") {
  const std::vector<float> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::uint32_t> indices{0, 1, 2};
  const double grey[3] = {0.5, 0.5, 0.5};
  bool all = false;
  for (std::uint64_t n = 1; !all; n += n < 100 ? 1 : n / 8) {
    CAPTURE(n);
    const std::int64_t live = heap::live();
    halflight_job* job = nullptr;
    {
      const heap::Failure failure{n, heap::Fails::once};
      std::uint32_t width = 0, height = 0;
      job = halflight_create();
      if (job != nullptr) {
        // Called all the same after one was refused, as a careless program does.
        static_cast<void>(halflight_add_material(job, "a name that is too long to stand in a string itself", grey, grey));
        static_cast<void>(halflight_set_number(job, "no such option, told in a long sentence", 1.0));
        static_cast<void>(halflight_set_number(job, "audit_points", 0.0));
        static_cast<void>(halflight_set_positions(job, xyz.data(), 3, 3));
        static_cast<void>(halflight_set_triangles(job, indices.data(), 1, nullptr));
        static_cast<void>(halflight_run(job));
        static_cast<void>(halflight_make_lightmap(job, 0.1, 64, &width, &height));
      }
      all = !failure.happened();
      halflight_destroy(job);
    }
    CHECK(heap::live() == live);
  }
}

TEST_CASE("whichever allocation fails, F-refinement has a coarser solution, or refuses, and nothing is lost") {
  check_all_failures(apps::stress::room_with_box(), small(), 1);
}

TEST_CASE("whichever allocation fails, BF-refinement has the solution of a generation before, or refuses") {
  check_all_failures(apps::stress::furnace_with_things(0.5), bf(), 2);
}

TEST_CASE("whichever allocation fails, an error target has the solution of a round before, or refuses") {
  Options options = small();
  options.error = 0.06;
  options.audit_points = 60;
  check_all_failures(apps::stress::two_plates(0.5), options, 3);
}

TEST_CASE("what a body throws reaches the caller, from any thread and any round, and nobody waits for ever") {
  const std::uint32_t seed = 4;
  CAPTURE(seed);
  std::mt19937 random{seed};
  for (int i = 0; i < 200; ++i) {
    const auto threads = static_cast<unsigned>(1 + random() % 6);
    std::vector<std::size_t> counts(1 + random() % 5);
    for (std::size_t& count : counts) { count = random() % 9; }
    const std::size_t bad_round = random() % counts.size();
    const std::size_t bad = counts[bad_round] > 0 ? random() % counts[bad_round] : 0;
    std::vector<std::vector<std::atomic<int>>> calls;
    for (const std::size_t count : counts) { calls.emplace_back(count); }
    const auto body = [&](std::size_t round, std::size_t k) {
      ++calls[round][k];
      if (round == bad_round && k == bad) { throw std::bad_alloc(); }
    };
    bool thrown = false;
    try {
      radiosity::parallel_rounds(counts, threads, body);
    } catch (const std::bad_alloc&) { thrown = true; }
    CHECK(thrown == (counts[bad_round] > 0));
    for (std::size_t round = 0; round < counts.size(); ++round) {
      for (const std::atomic<int>& n : calls[round]) {
        CHECK(n <= 1);
        if (thrown && round > bad_round) { CHECK(n == 0); }
        if (!thrown || round < bad_round) { CHECK(n == 1); }
      }
    }
    CHECK_THROWS_AS(radiosity::parallel_for(
                        100, threads,
                        [&](std::size_t k) {
                          if (k == bad) { throw std::bad_alloc(); }
                        },
                        1 + random() % 10),
                    std::bad_alloc);
  }
}

#if defined(__GLIBC__)
TEST_CASE("threads that cannot be started are done without: the same bits") {
  const Outcome whole = radiosity::solve(apps::stress::room_with_box(), small());
  REQUIRE(whole.solution);
  pthread_attr_t usual, huge;  // no system has room for a stack of 2^46 bytes
  REQUIRE(::pthread_getattr_default_np(&usual) == 0);
  REQUIRE(::pthread_getattr_default_np(&huge) == 0);
  REQUIRE(::pthread_attr_setstacksize(&huge, std::size_t{1} << 46) == 0);
  REQUIRE(::pthread_setattr_default_np(&huge) == 0);
  std::vector<std::jthread> none;
  const std::size_t started = radiosity::detail::start_threads(none, 4, [] {});
  const Outcome outcome = radiosity::solve(apps::stress::room_with_box(), small());
  REQUIRE(::pthread_setattr_default_np(&usual) == 0);
  CHECK(started == 0);
  REQUIRE(outcome.solution);
  CHECK(outcome.solution->radiosity == whole.solution->radiosity);
  ::pthread_attr_destroy(&usual);
  ::pthread_attr_destroy(&huge);
}
#endif
