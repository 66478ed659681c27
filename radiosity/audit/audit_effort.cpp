// SPDX-License-Identifier: MIT
#include <radiosity/audit/audit_effort.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <brep/inline.hpp>

#include <radiosity/result/error_estimate.hpp>

namespace radiosity {

namespace detail {

// An audit that shall show a mean square below the target takes so much that the gap between them is this many standard errors. The
// interval ends two above the mean; one more, because chance moves the mean. The margin, because a pilot mostly underestimates the
// variance.
inline constexpr double variance_margin = 1.1, errors_to_show = 3.0;

// A mean that is closer to the target than this fraction may be so by chance. The target then stays undecided, because a finer solution
// tells more for the same rays.
inline constexpr double least_gap = 0.15;

// The standard error of the mean that the goal requires, estimated from a pilot in which `met` points count. Where noise hides the error,
// the standard error of the pilot takes its place.
[[nodiscard]] HALFLIGHT_INLINE double standard_error_needed(const AuditGoal& goal, const ErrorSums::Moments& seen, double met) {
  const double target = goal.wanted ? *goal.wanted * *goal.wanted : 0.0;
  const double doubt = std::sqrt(seen.variance / met);
  return (goal.wanted ? std::max(std::abs(target - std::max(seen.ratio, 0.0)), 0.1 * target) / errors_to_show
                      : std::max(0.25 * std::max(seen.ratio, doubt), 0.5 * negligible_error * negligible_error)) /
         variance_margin;
}

// Predicts the effect of more or fewer paths at each point. The noise is that of a product of two estimates, so its variance falls at
// least with the square of the number of paths. The remaining variance is the difference between points. A pilot that sees only noise
// cannot separate the two, so at least a tenth is attributed to the points.
struct PathModel {
  double variance = 0.0, noise_share = 0.0;  // of one point (ErrorSums::Moments)
  double rays = 0.0;                         // rays a point
  std::uint32_t paths = 4;                   // paths a point of the pilot

  [[nodiscard]] double variance_at(std::uint32_t of) const {
    const double fewer = static_cast<double>(paths) / of, noise = std::clamp(noise_share, 1.0 / 32.0, 0.9);
    return variance * (1.0 - noise + noise * fewer * fewer);
  }
  [[nodiscard]] double rays_at(std::uint32_t of) const { return rays * of / paths; }
};

// The number of points and paths that reaches the standard error `off` with the least rays, or, if `left` rays do not suffice, the
// smallest standard error. At least `fewest` points (the share `met` of them sees light), and at least as many as `anyhow` rays pay for.
[[nodiscard]] HALFLIGHT_INLINE Effort best_effort(const PathModel& model, double off, double met, double fewest, double anyhow,
                                                  double left) {
  constexpr std::uint32_t least = 4, most_more = 8;
  Effort best;
  double best_variance = 0.0, best_rays = 0.0;
  // Try as few as a quarter of the paths if there is next to no noise, or if the rays do not suffice otherwise.
  std::uint32_t first = model.noise_share < 1.0 / 32.0 ? std::max(least, model.paths / 4) : model.paths;
  while (first > least && fewest * model.rays_at(first) > left) { first /= 4; }
  first = std::max(first, least);
  for (std::uint32_t paths = first; paths <= most_more * model.paths; paths *= 2) {
    const double rays = model.rays_at(paths), most = std::max(fewest, left / rays);
    if (paths > first && fewest * rays > left) { break; }
    const double enough = std::clamp(model.variance_at(paths) / (off * off * met), std::max(fewest, std::min(most, anyhow / rays)), most);
    const double variance = std::max(off * off, model.variance_at(paths) / (enough * met));
    const bool better = variance < 0.99 * best_variance || (variance < 1.01 * best_variance && enough * rays < best_rays);
    if (paths > first && !better) { continue; }
    constexpr double most_points = 1e15;  // beyond any budget, and still an integer
    best = {static_cast<std::uint64_t>(std::min(std::max(fewest, steady(enough)), most_points)), paths, false};
    best_variance = variance;
    best_rays = enough * rays;
  }
  return best;
}

// How many rays the audit may take in all, pilots included. `seen`: of `met` points with this model, which are the share `share` of all;
// `fewest`: least number of points; `spent`: rays so far.
[[nodiscard]] HALFLIGHT_INLINE double rays_allowed(const AuditGoal& goal, const ErrorSums::Moments& seen, const PathModel& model,
                                                   double met, double share, double fewest, double spent) {
  const auto plain = static_cast<double>(goal.rays), refine = static_cast<double>(goal.rays_to_refine);
  if (!goal.wanted) { return plain; }
  const double target = *goal.wanted * *goal.wanted, gap = target - std::max(seen.ratio, 0.0), doubt = std::sqrt(seen.variance / met);
  const double without = seen.ratio <= target ? std::max(plain, static_cast<double>(goal.rays_to_show)) : plain;
  if (goal.reserve == 0 || seen.ratio - 2.0 * doubt > target) { return without; }
  // To show an error that is so far below the target.
  const auto rays_to_show = [&](double below) {
    const Effort effort =
        best_effort(model, below / errors_to_show / variance_margin, share, fewest, 0.0, std::numeric_limits<double>::infinity());
    return static_cast<double>(effort.points) * model.rays_at(effort.paths);
  };
  // While noise hides the error, the audit may cost four times what the next round takes if the mean is below the target, and as much as
  // that round if it is above.
  constexpr double left_by_round = 0.3;  // of the mean square: a round leaves about 0.55 of the error
  const double much_cheaper = seen.ratio <= target ? 0.25 : 1.0;
  constexpr double likely_gap = 0.5;
  const bool known = doubt <= 0.5 * std::abs(gap);
  if (known && gap < least_gap * target) { return without; }
  const double now = rays_to_show(known ? gap : std::max(gap, likely_gap * target));
  const double worth = known ? refine + rays_to_show(target - left_by_round * (target - gap)) : refine / much_cheaper;
  const double most = std::max(plain, static_cast<double>(goal.rays_to_show)) + static_cast<double>(goal.reserve);
  return now <= worth && spent + now <= most ? std::clamp(spent + worth, without, most) : without;
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
  const double off = standard_error_needed(goal, *seen, met);
  const double needed = seen->variance / (off * off) * few / met;
  const PathModel model{seen->variance, seen->noise_share, own / few, pilot.paths};
  const double rays = rays_allowed(goal, *seen, model, met, met / few, fewest, used);
  // The noise variance falls with the square of the number of paths, so trading points for paths pays until noise makes up half of the
  // variance. Few points mostly underestimate its share. Where the least number of points already confirms the target, they may cost no
  // more than the solution. All pilots together take at most half of the rays.
  const auto affordable = [&](double all) {
    const double then = used + 4.0 * own;
    return 2.0 * then <= all && then + 4.0 * own * fewest / few <= all;
  };
  if (seen->noise_share > 0.2 && affordable(needed > static_cast<double>(least) ? rays : static_cast<double>(goal.rays))) {
    return {pilot.points, 4 * pilot.paths};
  }
  // If a few points outshine all others, the pilot estimates neither mean nor variance well.
  const bool uneven = seen->equal_points < std::min(16.0, met / 4.0);
  // Pilots may take more rays while they find the target met. If the last of them finds it missed, the audit takes as many rays as that
  // pilot.
  const double left = std::max(goal.wanted ? own : 0.0, rays - used);
  return best_effort(model, off, met / few, fewest, uneven ? left : static_cast<double>(goal.rays_anyhow), left);
}

HALFLIGHT_INLINE std::optional<Effort> further_effort(const AuditGoal& goal, const Effort& audit, const ErrorSums& sums,
                                                      std::uint64_t rays_of_audit, std::uint64_t spent) {
  const std::optional<ErrorSums::Moments> seen = sums.moments();
  const std::optional<ErrorEstimate> error = sums.estimate();
  if (!seen || !error || !(seen->variance > 0.0)) { return std::nullopt; }
  const auto points = static_cast<double>(audit.points), met = static_cast<double>(sums.square.size());
  const double doubt = std::sqrt(seen->variance / met), target = goal.wanted ? *goal.wanted * *goal.wanted : 0.0;
  // The interval is as wide as the error itself when the standard error is half of the mean square; aim at less, as a reserve for chance.
  // The same holds for a target, because the interval ends two standard errors above the mean.
  const PathModel model{seen->variance, std::max(seen->noise_share, 1.0 / 32.0), static_cast<double>(rays_of_audit) / points, audit.paths};
  double off = 0.25 * std::max(seen->ratio, doubt), most = 0.5 * (std::max(seen->ratio, 0.0) + doubt);
  auto left = goal.rays_if_wide > 0 ? static_cast<double>(goal.rays + goal.rays_if_wide) - static_cast<double>(spent) : 0.0;
  if (goal.wanted) {
    if (error->within(*goal.wanted) || seen->ratio > target) { return std::nullopt; }
    left = rays_allowed(goal, *seen, model, met, met / points, points / 2.0, static_cast<double>(spent)) - static_cast<double>(spent);
    off = std::max(target - std::max(seen->ratio, 0.0), least_gap * target) / errors_to_show;
    most = (target - std::max(seen->ratio, 0.0)) / 2.0;
  } else if (!is_wide(*error)) {
    return std::nullopt;
  }
  if (!(left > 0.0) || !(off > 0.0)) { return std::nullopt; }
  const Effort then = best_effort(model, off, met / points, points / 2.0, 0.0, left);
  const double reached = std::sqrt(model.variance_at(then.paths) * points / (static_cast<double>(then.points) * met));
  const bool fits = static_cast<double>(then.points) * model.rays_at(then.paths) <= 1.01 * left;
  return fits && reached < most && reached < 0.8 * doubt ? std::optional{then} : std::nullopt;
}

}  // namespace detail

}  // namespace radiosity
