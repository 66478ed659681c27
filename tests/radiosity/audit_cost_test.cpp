// SPDX-License-Identifier: MIT

// What audits and rounds to an accuracy target cost: no more than the stated budget, whatever they meet.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <raycast/objects/sphere.hpp>

#include <radiosity/audit/accuracy_target.hpp>
#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/run/solve_at.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"

using radiosity::AuditGoal;
using radiosity::Color;
using radiosity::ErrorEstimate;
using radiosity::ErrorSums;

namespace {

struct Points {
  ErrorSums sums;
  std::uint64_t rays = 0;
};

// Points of which a share sees light, with errors and noise of their own; `fixed` rays each, and some for each path.
struct Kind {
  double share, off, spread;
  std::uint64_t fixed, rays_a_path;
};

// What an audit of such points took in all, and what came of it.
struct Taken {
  std::uint64_t rays = 0, pilots = 0;
  std::uint64_t last = 0, before = 0;  // rays of the last measurement, and of the one before it
  Points result;
};

Taken audited(const Kind& kind, const AuditGoal& goal, std::uint64_t seed) {
  Taken taken;
  std::uint64_t asked = 0;
  const auto measure = [&](std::uint64_t points, std::uint32_t paths, Points& to) {
    for (std::uint64_t i = 0; i < points; ++i) {
      radiosity::Random at{seed, asked++};
      to.rays += kind.fixed;
      if (at.uniform() >= kind.share) { continue; }
      const double noise = kind.spread / std::sqrt(paths);
      const double a = noise * (at.uniform() - 0.5), b = noise * (at.uniform() - 0.5);
      to.sums.add((kind.off + a) * (kind.off + b), 1.0, std::pow(0.5 * (a - b) * (a - b), 2) / 3.0);
      to.rays += 2 * paths * kind.rays_a_path;
    }
    taken.pilots += 1;
    taken.rays += to.rays;
    taken.before = std::exchange(taken.last, to.rays);
    return true;
  };
  REQUIRE(radiosity::measure_to_goal<Points>(
      measure, [](const Points& p) -> const ErrorSums& { return p.sums; }, goal, taken.result));
  return taken;
}

}  // namespace

TEST_CASE("an audit takes about the rays that it may, pilots included, or the least that gives an interval") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 300; ++k) {
    const Kind kind{std::pow(10.0, -3.0 * random.uniform()), std::pow(10.0, -4.0 + 3.0 * random.uniform()),
                    std::pow(10.0, -3.0 + 4.0 * random.uniform()), 1 + static_cast<std::uint64_t>(30.0 * random.uniform()),
                    1 + static_cast<std::uint64_t>(40.0 * random.uniform())};
    const auto points = 16 + static_cast<std::uint64_t>(2000.0 * random.uniform());
    AuditGoal goal{points, static_cast<std::uint64_t>(std::pow(10.0, 3.0 + 3.0 * random.uniform()))};
    if (k % 2 == 0) {
      goal.wanted = std::pow(10.0, -2.5 + 1.5 * random.uniform());
      goal.rays_to_show = 2 * goal.rays;
    } else if (k % 4 == 1) {
      goal.rays_if_wide = goal.rays;
    }
    const Taken taken = audited(kind, goal, seed + static_cast<std::uint64_t>(k));
    // The least: a pilot and an audit of the fewest points, with four paths for each estimate, or with 16 in the pilot where it is rich.
    const std::uint64_t fewest =
        std::max<std::uint64_t>(goal.wanted ? 250 : 16, std::max(points / 4, std::clamp<std::uint64_t>(points / 8, 16, 512)));
    const auto seen = [&](std::uint64_t n) {  // points of so many, by six standard errors at most
      const double mean = kind.share * static_cast<double>(n);
      return std::min(static_cast<double>(n), mean + 6.0 * std::sqrt(mean) + 6.0);
    };
    const std::uint64_t paths = goal.rays < 256 * fewest ? 4 : 16;
    const double least =
        2.0 * static_cast<double>(fewest * kind.fixed) + 2.0 * seen(fewest) * static_cast<double>((paths + 16) * kind.rays_a_path);
    const double most = static_cast<double>(std::max(goal.rays, goal.rays_to_show) + goal.rays_if_wide);
    CAPTURE(k, kind.share, kind.off, kind.spread, kind.fixed, kind.rays_a_path, points, goal.rays, goal.rays_to_show, taken.rays, least);
    // What a point costs is known from a pilot, in which 16 points see light at least: to a quarter, so twice as much is four standard
    // errors off.
    CHECK(static_cast<double>(taken.rays) <= 2.0 * most + least);
  }
}

TEST_CASE("an audit that goes on narrows what was wide and shows targets that were left open, what was enough stays as it is") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  int wide[2] = {0, 0}, shown[2] = {0, 0};
  for (int k = 0; k < 200; ++k) {
    // Noise that a few times the rays bring below the error.
    const double off = std::pow(10.0, -2.5 + random.uniform());
    const Kind kind{1.0, off, off * std::pow(10.0, 1.2 + 0.6 * random.uniform()), 1, 8};
    AuditGoal goal{500, 100'000};
    const Points once = audited(kind, goal, seed + static_cast<std::uint64_t>(k)).result;
    goal.rays_if_wide = 200'000;
    const Points again = audited(kind, goal, seed + static_cast<std::uint64_t>(k)).result;
    const bool was_wide = radiosity::is_wide(*once.sums.estimate());
    wide[0] += was_wide;
    wide[1] += radiosity::is_wide(*again.sums.estimate());
    if (!was_wide) { CHECK(again.sums.square == once.sums.square); }
    goal = {500, 100'000};
    goal.wanted = 1.3 * off;
    goal.rays_to_show = 100'000;
    shown[0] += audited(kind, goal, seed + static_cast<std::uint64_t>(k)).result.sums.estimate()->within(*goal.wanted);
    goal.rays_to_show = 400'000;
    shown[1] += audited(kind, goal, seed + static_cast<std::uint64_t>(k)).result.sums.estimate()->within(*goal.wanted);
  }
  CAPTURE(wide[0], wide[1], shown[0], shown[1]);
  CHECK(wide[0] > 20);
  // About 35 % of some 78 stay wide, because chance made them so or hid that more rays would do: 27 with a standard deviation of 4.2. The
  // bound is six of these off.
  CHECK(wide[1] <= 2 * wide[0] / 3);
  CHECK(shown[1] > shown[0]);
}

TEST_CASE("a picture that is good enough is known to be so by what it cost, however cheap its solution was") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  int alone = 0, with_picture = 0;
  for (int k = 0; k < 100; ++k) {
    radiosity::Audit audit;
    audit.links = static_cast<std::uint64_t>(std::pow(10.0, 3.0 + 2.0 * random.uniform()));
    const double off = 0.005 + 0.005 * random.uniform();
    const Kind kind{1.0, off, off * (60.0 + 60.0 * random.uniform()), 1, 8};  // noise that the rays of the solution alone do not overcome
    const AuditGoal goal = radiosity::goal_of_round(audit, 500, 2.0 * off);
    const AuditGoal both = goal.and_picture(2'000'000);  // 800 x 600 pixels among few polygons
    CHECK(both.rays_to_steer == goal.rays_to_steer);     // what plans the rounds does not depend on the picture
    const auto key = seed + static_cast<std::uint64_t>(k);
    alone += audited(kind, goal, key).result.sums.estimate()->within(2.0 * off);
    with_picture += audited(kind, both, key).result.sums.estimate()->within(2.0 * off);
  }
  CAPTURE(alone, with_picture);
  CHECK(with_picture > alone + 20);
}

TEST_CASE("an audit takes from the reserve what shows a target that noise hides, if another round costs about as much, and never more") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  int shown[3] = {0, 0, 0};
  for (int k = 0; k < 200; ++k) {
    const double off = std::pow(10.0, -3.0 + random.uniform());
    const Kind kind{1.0, off, off * (150.0 + 40.0 * random.uniform()), 1, 8};  // noise that rays_to_show seldom overcome
    AuditGoal goal{500, 20'000};
    goal.wanted = 2.0 * off;
    goal.rays_to_show = 400'000;
    const auto key = seed + static_cast<std::uint64_t>(k);
    const auto shows = [&](const Taken& taken) { return taken.result.sums.estimate()->within(*goal.wanted) ? 1 : 0; };
    const Taken without = audited(kind, goal, key);
    goal.reserve = 4'000'000;
    goal.rays_to_refine = 100;  // a round that costs nothing
    const Taken cheap = audited(kind, goal, key);
    goal.rays_to_refine = 2'000'000;
    const Taken dear = audited(kind, goal, key);
    shown[0] += shows(without);
    shown[1] += shows(cheap);
    shown[2] += shows(dear);
    CAPTURE(k, off, kind.spread, without.rays, cheap.rays, dear.rays);
    // The least is exceeded as without a reserve: pilots and an audit of 250 points with few paths.
    const std::uint64_t least = 2 * 250 * (1 + 2 * 32 * 8);
    CHECK(cheap.rays <= 2 * goal.rays_to_show + least);
    CHECK(dear.rays <= goal.rays_to_show + goal.reserve + least);
    CHECK(radiosity::used_of_reserve(goal, dear.rays) <= goal.reserve + least);
  }
  CAPTURE(shown[0], shown[1], shown[2]);
  // About 22 % are shown with the reserve and 2 % without, so 40 of 200 more, with a standard deviation of 6. The bound is four of these
  // off.
  CHECK(shown[2] > shown[0] + 16);
  CHECK(shown[2] > shown[1] + 16);
}

TEST_CASE("rounds to a target share one reserve of rays, and are the same whatever their audits take of it") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 100; ++k) {
    const bool of_picture = k % 2 == 0;
    std::vector<double> epsilons[2];
    for (const bool takes : {false, true}) {
      std::uint64_t taken = 0, left = 0;
      radiosity::Random gain{seed, static_cast<std::uint64_t>(k)};
      const auto solve_round = [&](const radiosity::Options& round, auto) {
        if (epsilons[takes].empty()) { left = round.audit_reserve; }
        CHECK(round.audit_reserve == left - taken);
        epsilons[takes].push_back(round.epsilon);
        const double error = round.epsilon * (0.9 + 0.1 * gain.uniform());
        radiosity::Solution solution;
        radiosity::Audit& audit = solution.audit;
        audit.links = 1000;
        audit.light_epsilon = round.epsilon;
        audit.steering_error = ErrorEstimate{error, 0.01 * error, 0.98 * error, 1.02 * error};
        audit.surface_error = audit.steering_error;
        audit.picture_error = radiosity::PictureError{};
        audit.picture_error->steering = audit.picture_error->error = *audit.steering_error;
        const auto used = takes ? static_cast<std::uint64_t>(random.uniform() * static_cast<double>(round.audit_reserve)) : 0;
        (of_picture ? audit.picture_error->reserve_used : audit.reserve_used) = used;
        taken += used;
        return radiosity::Outcome{std::move(solution), {}};
      };
      const auto as_before = [](const radiosity::Solution& solution) { return solution.audit.picture_error; };
      const radiosity::Options options{.error = 1e-3};
      const radiosity::Outcome outcome = of_picture ? radiosity::detail::solve_to_error(options, solve_round, as_before)
                                                    : radiosity::detail::solve_to_error(options, solve_round);
      REQUIRE(outcome.solution);
      CHECK(left == 40'000'000);
      CHECK(taken <= left);
    }
    CHECK(epsilons[0] == epsilons[1]);
  }
}

TEST_CASE("an audit of a target that leaves it open took about as many rays as its last pilot") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  int open = 0;
  for (int k = 0; k < 300; ++k) {
    const double off = std::pow(10.0, -3.0 + 1.5 * random.uniform());
    const Kind kind{1.0, off, off * std::pow(10.0, 1.0 + 1.5 * random.uniform()), 1, 8};
    AuditGoal goal{1000 + static_cast<std::uint64_t>(3000.0 * random.uniform()), 400'000};
    goal.wanted = off * (0.7 + 0.6 * random.uniform());
    goal.rays_to_show = static_cast<std::uint64_t>(400'000 * (1.0 + 5.0 * random.uniform()));
    const Taken taken = audited(kind, goal, seed + static_cast<std::uint64_t>(k));
    const auto error = taken.result.sums.estimate();
    REQUIRE(error);
    if (error->within(*goal.wanted) || error->low > *goal.wanted) { continue; }
    ++open;
    CAPTURE(k, kind.off, kind.spread, goal.points, *goal.wanted, goal.rays_to_show, taken.before, taken.last);
    CHECK(5 * taken.last >= 2 * taken.before);  // paths are powers of 2, points of its fourth root, each rounded down
  }
  CHECK(open > 20);
}

TEST_CASE("an audit of what is black ends with its search for light, a quarter of its rays, and measures nothing") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 50; ++k) {
    const auto points = 16 + static_cast<std::uint64_t>(4000.0 * random.uniform());
    const std::uint64_t fixed = 1 + static_cast<std::uint64_t>(50.0 * random.uniform());
    const AuditGoal goal{points, static_cast<std::uint64_t>(std::pow(10.0, 3.0 + 4.0 * random.uniform()))};
    const Taken taken = audited({0.0, 0.0, 0.0, fixed, 1}, goal, seed);
    CAPTURE(k, points, fixed, goal.rays, taken.rays);
    CHECK(taken.rays <= std::max(goal.rays / 4, std::clamp<std::uint64_t>(points / 8, 16, 512) * fixed));
    CHECK_FALSE(taken.result.sums.estimate());
  }
}

TEST_CASE("a target out of reach ends within the stated work, and after the same rounds as any other") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 200; ++k) {
    const auto key = static_cast<std::uint64_t>(k);
    const double growth = 1.1 + 0.9 * random.uniform(), first = std::pow(10.0, 3.0 + 4.0 * random.uniform());
    const auto picture_work = static_cast<std::uint64_t>(std::pow(10.0, 7.0 * random.uniform()));
    // Rounds of random gain, of which audits see with random noise what they are off.
    const auto run = [&](double wanted) {
      std::uint64_t work = 0, rounds = 0;
      double error = 0.5;
      const radiosity::Options options{.error = wanted};
      const auto solve_round = [&](const radiosity::Options& round, auto) {
        CHECK(round.allowed_memory().has_value());
        radiosity::Random gain{seed, key, rounds};
        error *= 0.8 + 0.1 * gain.uniform();
        radiosity::Solution solution;
        radiosity::Audit& audit = solution.audit;
        audit.links = static_cast<std::uint64_t>(std::min(9e6, first * std::pow(growth, static_cast<double>(rounds))));
        audit.light_epsilon = round.epsilon;
        audit.picture_error = radiosity::PictureError{};
        audit.picture_error->picture_work = picture_work;
        audit.picture_error->steering = ErrorEstimate{error, 0.01 * error, 0.98 * error, 1.02 * error};
        audit.picture_error->error = *audit.picture_error->steering;
        work += audit.links + picture_work;
        ++rounds;
        return radiosity::Outcome{std::move(solution), {}};
      };
      const auto as_before = [](const radiosity::Solution& solution) { return solution.audit.picture_error; };
      const radiosity::Outcome outcome = radiosity::detail::solve_to_error(options, solve_round, as_before);
      REQUIRE(outcome.solution);
      CHECK((rounds == 1 || work <= 40'000'000));
      return std::pair{rounds, outcome.solution->audit};
    };
    const auto [rounds, missed] = run(1e-9);
    const auto [again, looser] = run(0.01);
    CAPTURE(k, growth, first, picture_work, rounds, again, missed.rounds_ended_by);
    CHECK(missed.target_missed);
    CHECK_FALSE(missed.rounds_ended_by.empty());
    CHECK(again <= rounds);
    CHECK(missed.picture_error->error.relative_l2 <= looser.picture_error->error.relative_l2);
  }
}

TEST_CASE("the audits of random scenes cost what is stated: as much time as the solution, or 5000 rays a point where that is more",
          "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int k = 0; k < 6; ++k) {
    radiosity::Scene scene = scenes::two_plates(0.2 + 0.7 * random.uniform());
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({"ball", Color{0.9 * random.uniform()}, Color{0.0}});
    for (int ball = 0; ball < 10 * k; ++ball) {
      const glm::dvec3 centre{3.0 * random.uniform(), 3.0 * random.uniform(), 3.0 * random.uniform()};
      scene.objects.push_back({"ball", raycast::Sphere::make(centre, 0.02 + 0.1 * random.uniform()).object, {}, {material}});
    }
    radiosity::Options options{.epsilon = 0.05, .min_area = 1e-3, .audit_points = 200, .seed = seed + static_cast<std::uint64_t>(k)};
    if (k % 2 == 1) { options.error = 1e-6; }  // of which this is one round
    const radiosity::Outcome outcome = radiosity::detail::solve_within_memory(scene, options, {}, 0);
    REQUIRE(outcome.solution);
    const radiosity::Audit& audit = outcome.solution->audit;
    const std::uint64_t worth = radiosity::rays_worth(audit),
                        most = options.error ? worth
                                             : std::max<std::uint64_t>(3 * worth, radiosity::rays_to_know_a_point * options.audit_points);
    CAPTURE(k, audit.ray_price, worth, audit.audit_rays);
    // The least: pilot, audit and steering points with few paths each, of some ten rays; more where the scene is white.
    constexpr double least = 2.0 * (256 + 250 + 50) * 16 * 12;
    CHECK(static_cast<double>(audit.audit_rays) * audit.ray_price <= 1.25 * static_cast<double>(most) + audit.ray_price * least);
  }
}
