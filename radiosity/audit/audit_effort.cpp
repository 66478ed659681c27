// SPDX-License-Identifier: MIT
#include <radiosity/audit/audit_effort.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <raycast/inline.hpp>

#include <radiosity/result/error_estimate.hpp>

namespace radiosity {

namespace detail {

// The number of points that shows what the goal asks for, by what a pilot of `few` points saw, of which `met` count. It gives the standard
// error of the mean that is needed. The pilot's own doubt stands in for an error that it hides; an error below `negligible` need not be
// known.
[[nodiscard]] HALFLIGHT_INLINE double points_needed(const AuditGoal& goal, const ErrorSums::Moments& seen, double few, double met) {
  constexpr double negligible = 0.005;
  const double target = goal.wanted ? *goal.wanted * *goal.wanted : 0.0;
  const double doubt = std::sqrt(seen.variance / met);
  const double off = goal.wanted ? std::max(std::abs(target - seen.ratio), 0.1 * target) / 2.5
                                 : std::max(0.25 * std::max(seen.ratio, doubt), 0.5 * negligible * negligible);
  return 1.2 * seen.variance / (off * off) * few / met;  // with those that see none
}

HALFLIGHT_INLINE Effort next_effort(const AuditGoal& goal, std::uint64_t least, const Effort& pilot, const ErrorSums& sums,
                                    std::uint64_t rays_of_pilot, std::uint64_t spent) {
  const auto few = static_cast<double>(pilot.points), own = static_cast<double>(rays_of_pilot), used = static_cast<double>(spent);
  const auto fewest = static_cast<double>(std::max(least, pilot.points));
  const std::optional<ErrorSums::Moments> seen = sums.moments();
  const auto met = static_cast<double>(sums.square.size());
  if (!seen || met < 16.0) {  // too few points see light; the search for more may take a quarter of all rays
    const bool more = 4 * pilot.points <= 64 * least && 4.0 * (used + 4.0 * own) <= static_cast<double>(goal.rays);
    if (more) { return {4 * pilot.points, pilot.paths}; }
    const bool light = std::any_of(sums.reference.begin(), sums.reference.end(), [](double r) { return r != 0.0; });
    return {pilot.points, pilot.paths, false, light};
  }
  const double target = goal.wanted ? *goal.wanted * *goal.wanted : 0.0;
  if (goal.wanted && seen->ratio - 4.0 * std::sqrt(seen->variance / met) > target) {  // too large, whatever the noise
    return {pilot.points, pilot.paths, false};
  }
  const double needed = points_needed(goal, *seen, few, met);
  const std::uint64_t rays = goal.wanted && seen->ratio <= target ? std::max(goal.rays, goal.rays_to_show) : goal.rays;
  // The noise of the paths falls with the square of their number, so more paths at fewer points pay until it is half of the variance.
  // From few points its share is mostly seen too small. Where the least number of points shows the target, they may cost no more than
  // the solution. All pilots together take half of the rays at most.
  const auto affordable = [&](std::uint64_t of) {
    const double then = used + 4.0 * own, all = static_cast<double>(of);
    return 2.0 * then <= all && then + 4.0 * own * fewest / few <= all;
  };
  if (seen->noise_share > 0.2 && affordable(needed > static_cast<double>(least) ? rays : goal.rays)) {
    return {pilot.points, 4 * pilot.paths};
  }
  std::uint32_t paths = pilot.paths;
  if (seen->noise_share < 1.0 / 32.0 && paths > 4) { paths /= 4; }
  const double rays_a_point = own / few, left = std::max(0.0, static_cast<double>(rays) - used);
  const double most = std::max(static_cast<double>(least), left / rays_a_point);
  for (double taken = fewest * rays_a_point; paths > 4 && taken > left; taken /= 4.0) { paths /= 4; }
  // A pilot in which a few points outshine all others knows little of either mean.
  const bool uneven = seen->equal_points < std::min(16.0, met / 4.0);
  const double anyhow = uneven ? most : std::min(most, static_cast<double>(goal.rays_anyhow) / rays_a_point);
  return {static_cast<std::uint64_t>(std::clamp(needed, std::max(fewest, anyhow), std::max(fewest, most))), paths, false};
}

}  // namespace detail

}  // namespace radiosity
