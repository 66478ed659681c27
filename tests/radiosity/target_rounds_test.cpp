// SPDX-License-Identifier: MIT

// Rounds to an error target: a tighter one never ends with a worse solution, and neither the target nor the noise of the audits changes the
// rounds themselves.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <radiosity/audit/accuracy_target.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/run/solve_at.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

using radiosity::Color;
using radiosity::Scene;

TEST_CASE("error target: a tighter one never ends with a worse solution, and one out of reach ends with the best") {
  radiosity::Options options{.threads = 1};
  std::uint64_t links = 0;
  double high = 1.0;
  for (const radiosity::Refinement refinement : {radiosity::Refinement::a_priori, radiosity::Refinement::a_posteriori}) {
    options.refinement = refinement;
    links = 0;
    high = 1.0;
    for (const double wanted : {0.2, 0.1, 0.05, 0.02}) {
      options.error = wanted;
      const radiosity::Solution solution = scenes::solved(scenes::two_plates(0.5), options);
      const radiosity::Audit& audit = solution.audit;
      REQUIRE(audit.surface_error);
      CAPTURE(wanted, audit.links, links, audit.surface_error->low, audit.surface_error->high);
      CHECK(audit.converged == audit.surface_error->within(wanted));
      CHECK(audit.target_missed != audit.surface_error->within(wanted));
      CHECK(audit.links >= links);
      CHECK(audit.surface_error->low <= high);  // as far as both intervals can tell
      links = audit.links;
      high = audit.surface_error->high;
    }
  }
}

namespace {

// What each round to an error target was asked for.
struct RoundsAsked {
  std::vector<std::array<double, 4>> fineness;
  radiosity::Outcome outcome;
};
RoundsAsked rounds_to(double wanted, radiosity::Options options, const Scene& scene) {
  RoundsAsked asked;
  options.error = wanted;
  asked.outcome = radiosity::detail::solve_to_error(options, [&](const radiosity::Options& round, std::uint64_t held) {
    asked.fineness.push_back({round.epsilon, round.min_area, round.light_epsilon.value_or(0.0), round.target});
    return radiosity::detail::solve_within_memory(scene, round, {}, held);
  });
  return asked;
}

}  // namespace

TEST_CASE("error target: the rounds are the same for any target as far as they go, and what ended them is told", "[slow]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 6; ++k) {
    Scene scene = scenes::two_plates(0.2 + 0.7 * random.uniform());
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({"ball", Color{0.3 + 0.6 * random.uniform()}, Color{0.0}});
    const double radius = 0.05 + 0.2 * random.uniform();
    scene.objects.push_back(
        {"ball", raycast::Sphere::make({random.uniform(), random.uniform(), radius + 0.1}, radius).object, {}, {material}});
    const radiosity::Options options{.audit_points = 400, .seed = static_cast<std::uint64_t>(k)};
    RoundsAsked before;
    for (const double wanted : {0.2, 0.08, 0.03, 0.015}) {
      RoundsAsked now = rounds_to(wanted, options, scene);
      REQUIRE(now.outcome.solution);
      const radiosity::Audit& audit = now.outcome.solution->audit;
      CAPTURE(k, wanted, before.fineness.size(), now.fineness.size(), audit.rounds_ended_by);
      CHECK(audit.target_missed == !audit.rounds_ended_by.empty());
      const auto common = static_cast<std::ptrdiff_t>(std::min(before.fineness.size(), now.fineness.size()));
      CHECK(std::equal(before.fineness.begin(), before.fineness.begin() + common, now.fineness.begin()));
      // The larger audit of a tighter target may show sooner that it is met. What is missed has gone through all rounds.
      if (audit.target_missed) { CHECK(now.fineness.size() >= before.fineness.size()); }
      before = std::move(now);
    }
  }
}

TEST_CASE("error target: however the noise of the audits falls, the rounds are the same and end no sooner for a tighter one") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 200; ++k) {
    const std::uint64_t key = static_cast<std::uint64_t>(k);
    const double floor = 0.1 * random.uniform();
    const auto rounds = [&](double wanted) {
      std::vector<double> epsilons;
      const radiosity::Options options{.error = wanted};
      radiosity::Random noise{seed, key, static_cast<std::uint64_t>(1e6 * wanted)};  // of the audits
      radiosity::Random steers{seed, key, 0};                                        // the same for all targets
      const auto solve_round = [&](const radiosity::Options& round, auto) {
        epsilons.push_back(round.epsilon);
        const auto around = [&](radiosity::Random& from) {
          const double error = (floor + round.epsilon) * (0.7 + 0.6 * from.uniform()), off = from.uniform() * error * 1.2;
          return radiosity::ErrorEstimate{error, 0.5 * off, std::max(0.0, error - off), error + off};
        };
        radiosity::Solution solution;
        radiosity::Audit& audit = solution.audit;
        audit.light_epsilon = round.epsilon;
        audit.direct_share = steers.uniform();
        audit.steering_error = around(steers);
        audit.surface_error = around(noise);
        audit.picture_error = radiosity::PictureError{};
        audit.picture_error->steering = audit.steering_error;
        audit.picture_error->error = *audit.surface_error;
        return radiosity::Outcome{std::move(solution), {}};
      };
      const auto as_before = [](const radiosity::Solution& solution) { return solution.audit.picture_error; };
      const radiosity::Outcome outcome = k % 2 == 0 ? radiosity::detail::solve_to_error(options, solve_round, as_before)
                                                    : radiosity::detail::solve_to_error(options, solve_round);
      REQUIRE(outcome.solution);
      return std::pair{epsilons, outcome.solution->audit.target_missed};
    };
    const auto [loose, missed] = rounds(0.06);
    const auto [tight, missed_tight] = rounds(0.03);
    CAPTURE(k, floor, loose.size(), tight.size(), missed, missed_tight);
    const std::size_t common = std::min(loose.size(), tight.size());
    CHECK(std::equal(tight.begin(), tight.begin() + static_cast<std::ptrdiff_t>(common), loose.begin()));
    // Audits that found by chance what is not there may end rounds early; what is missed ends with the same round for both.
    if (missed_tight) { CHECK(tight.size() >= loose.size()); }
    if (missed && missed_tight) { CHECK(tight.size() == loose.size()); }
  }
}

// As if the light that causes the error passed through an opening that only the patches of round `found` are small enough for.
TEST_CASE("error target: rounds without gain end a run only once they are a good part of the work that it may do") {
  const auto ended = [](std::size_t found, std::uint64_t links_of_round) {
    std::size_t rounds = 0;
    const auto solve_round = [&](const radiosity::Options& round, auto) {
      const double error = rounds++ < found ? 0.2 : 0.01;
      radiosity::Solution solution;
      solution.audit.light_epsilon = round.epsilon;
      solution.audit.links = links_of_round;
      solution.audit.steering_error = solution.audit.surface_error =
          radiosity::ErrorEstimate{error, 0.01 * error, 0.98 * error, 1.02 * error};
      return radiosity::Outcome{std::move(solution), {}};
    };
    const radiosity::Outcome outcome = radiosity::detail::solve_to_error({.error = 0.02}, solve_round);
    REQUIRE(outcome.solution);
    CHECK(outcome.solution->audit.target_missed == (rounds <= found));
    return std::pair{rounds, outcome.solution->audit.rounds_ended_by};
  };
  for (const std::size_t found : {1u, 5u, 9u}) {
    CHECK(ended(found, 1000) == std::pair{found + 1, std::string()});  // each is done in a millisecond
  }
  const auto [rounds, reason] = ended(9, 6'000'000);  // in seconds
  CHECK(rounds < 9);
  CHECK(reason == "three rounds without gain");
}

TEST_CASE("error target: the verdict on a picture is that of its last audit, whatever those of the rounds found") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  int met[2] = {0, 0};
  for (int k = 0; k < 200; ++k) {
    radiosity::Options options;
    options.error = 0.02;
    const auto estimate = [&] {
      const double error = 0.04 * random.uniform(), off = 0.03 * random.uniform();
      return radiosity::ErrorEstimate{error, 0.5 * off, std::max(0.0, error - off), error + off};
    };
    std::vector<bool> is_short;  // of memory, by round
    int again = 0;
    const auto solve_round = [&](const radiosity::Options& round, auto) {
      radiosity::Solution solution;
      solution.audit.light_epsilon = round.epsilon;
      solution.audit.picture_error = radiosity::PictureError{};
      solution.audit.picture_error->error = estimate();
      solution.audit.leaves = is_short.size();
      is_short.push_back(random.uniform() < 0.2);
      if (is_short.back()) { solution.audit.shortage = "no more memory"; }
      return radiosity::Outcome{std::move(solution), {}};
    };
    const auto measure_again = [&](const radiosity::Solution&) -> std::optional<radiosity::PictureError> {
      ++again;
      if (random.uniform() < 0.2) { return std::nullopt; }  // no pixel shows reflected light
      radiosity::PictureError error;
      error.error = estimate();
      return error;
    };
    const radiosity::Outcome outcome = radiosity::detail::solve_to_error(options, solve_round, measure_again);
    REQUIRE(outcome.solution);
    const radiosity::Audit& audit = outcome.solution->audit;
    const bool within = audit.picture_error->error.within(*options.error);
    CAPTURE(k, again, within, audit.rounds_ended_by, audit.shortage);
    CHECK(audit.target_missed != within);
    CHECK(audit.rounds_ended_by.empty() == within);
    CHECK(audit.converged == (within && audit.shortage.empty()));
    CHECK(again <= 1);
    if (again == 0) { CHECK(within); }
    // What ran short after the solution that is returned matters only if that misses the target.
    CHECK(audit.shortage.empty() != (is_short[audit.leaves] || (!within && is_short.back())));
    if (within) { ++met[again]; }
  }
  CHECK(met[0] > 20);
  CHECK(met[1] > 5);
}
