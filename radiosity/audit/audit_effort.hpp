// SPDX-License-Identifier: MIT
#pragma once

// How many points, and how many paths at each, an audit takes. An audit that went on until its result looked good enough would end more
// often where it errs to that side. So a small pilot decides how much is measured, and what is reported is measured at fresh points whose
// number was fixed before.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>

namespace radiosity {

struct AuditGoal {
  std::uint64_t points = 2000;      // about: a quarter of them at least, more where the points differ much
  std::uint64_t rays = 0;           // at most, unless the least number of points takes more; as dear as among few polygons
  std::optional<double> wanted{};   // relative L2 that is to be shown, or shown to be missed; else the error is to be known to a quarter
  std::uint64_t rays_to_show = 0;   // at most when the pilot finds the error to be what is wanted: that is then all that is left to do
  std::uint64_t rays_anyhow = 0;    // at least: a pilot may have met the few points that matter by chance, or missed them
  std::uint64_t rays_to_steer = 0;  // at most, for what decides how to refine further: it must not depend on what is wanted

  // The same where a ray costs `work` times as much (raycast::Scene::ray_work).
  [[nodiscard]] AuditGoal among_rays_of(double work) const {
    const auto fewer = [work](std::uint64_t count) { return static_cast<std::uint64_t>(static_cast<double>(count) / work); };
    return {points, fewer(rays), wanted, fewer(rays_to_show), fewer(rays_anyhow), fewer(rays_to_steer)};
  }
};

// The points by which rounds are planned (Audit::steering_error), and the paths at each.
inline constexpr std::uint64_t steering_points = 256;
[[nodiscard]] inline std::uint32_t steering_paths(const AuditGoal& goal) {
  constexpr std::uint64_t rays_a_path = 8;  // about
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(goal.rays_to_steer / (2 * steering_points * rays_a_path), 4, 256));
}

// As many rays of paths as the solution took time, or somewhat less: among few polygons, a link takes at least as long as a ray of a path.
// A segment of a link takes an eighth of that in any scene: it ends, goes the way of fifteen others, and looks for nothing but a blocker.
[[nodiscard]] inline std::uint64_t rays_worth(const Audit& audit) {
  return audit.links + static_cast<std::uint64_t>(audit.ray_work * static_cast<double>(audit.rays) / 8.0);
}

// For an audit without a target: as long as the solution took, or 1000 rays a point.
[[nodiscard]] inline AuditGoal goal_to_know(const Audit& audit, std::uint32_t points) {
  const std::uint64_t worth = rays_worth(audit);
  return {points, std::max<std::uint64_t>(worth, 1000 * std::uint64_t{points}), {}, 0, worth / 2};
}

// `measure(points, paths, result)` adds that many fresh points to the result and returns false when it was cancelled; a Measured has
// `rays`, and `sums(measured)` are those that matter. False when it was cancelled: the result then has no meaning.
template <class Measured>
[[nodiscard]] bool measure_to_goal(const std::function<bool(std::uint64_t points, std::uint32_t paths, Measured&)>& measure,
                                   const std::function<const ErrorSums&(const Measured&)>& sums, const AuditGoal& goal, Measured& result) {
  const std::uint64_t least = std::max<std::uint64_t>(goal.wanted ? 250 : 16, goal.points / 4);
  const double target = goal.wanted ? *goal.wanted * *goal.wanted : 0.0;
  std::uint64_t few = std::clamp<std::uint64_t>(goal.points / 8, 16, 512);  // points of the pilot
  constexpr std::uint64_t rays_a_path = 8;                                  // about
  std::uint32_t paths = goal.rays < 2 * 16 * rays_a_path * least ? 4 : 16;
  std::uint64_t points = least;
  for (;;) {
    Measured pilot;
    if (!measure(few, paths, pilot)) { return false; }
    const double rays_a_point = static_cast<double>(pilot.rays) / static_cast<double>(few);
    const auto affordable = [&](double factor, std::uint64_t rays) {
      return factor * static_cast<double>(least) * rays_a_point <= static_cast<double>(rays);
    };
    const std::optional<ErrorSums::Moments> seen = sums(pilot).moments();
    const auto met = static_cast<double>(sums(pilot).square.size());
    if (!seen || met < 16.0) {  // too few points see light
      if (4 * few > 64 * least || !affordable(4.0 * static_cast<double>(few) / static_cast<double>(least), goal.rays)) { break; }
      points = few *= 4;
      continue;
    }
    const double doubt = std::sqrt(seen->variance / met);
    if (goal.wanted && seen->ratio - 4.0 * doubt > target) {  // too large, whatever the noise
      points = few;
      break;
    }
    // The standard error of the mean that is needed, and the points that give it. The pilot's own doubt stands in for an error that it
    // hides; an error below `negligible` need not be known.
    constexpr double negligible = 0.005;
    const double off = goal.wanted ? std::max(std::abs(target - seen->ratio), 0.1 * target) / 2.5
                                   : std::max(0.25 * std::max(seen->ratio, doubt), 0.5 * negligible * negligible);
    const double needed = 1.2 * seen->variance / (off * off) * static_cast<double>(few) / met;  // with those that see none
    const std::uint64_t rays = goal.wanted && seen->ratio <= target ? std::max(goal.rays, goal.rays_to_show) : goal.rays;
    // The noise of the paths falls with the square of their number, so more paths at fewer points pay until it is half of the variance.
    // From few points its share is mostly seen too small. Where the least number of points shows the target, they may cost no more than
    // the solution.
    if (seen->noise_share > 0.2 && affordable(4.0, needed > static_cast<double>(least) ? rays : goal.rays)) {
      paths *= 4;
      continue;
    }
    if (seen->noise_share < 1.0 / 32.0 && paths > 4) { paths /= 4; }
    const auto most = std::max(static_cast<double>(least), static_cast<double>(rays) / rays_a_point);
    // A pilot in which a few points outshine all others knows little of either mean.
    const bool uneven = seen->equal_points < std::min(16.0, met / 4.0);
    const double anyhow = uneven ? most : std::min(most, static_cast<double>(goal.rays_anyhow) / rays_a_point);
    const double fewest = static_cast<double>(std::max(least, few));
    points = static_cast<std::uint64_t>(std::clamp(needed, std::max(fewest, anyhow), std::max(fewest, most)));
    break;
  }
  return measure(points, paths, result);
}

}  // namespace radiosity
