// SPDX-License-Identifier: MIT
#pragma once

// How many points, and how many paths at each, an audit takes. An audit that went on until its result looked good enough would end more
// often where it errs to that side. So a small pilot decides how much is measured, and what is reported is measured at fresh points whose
// number was fixed before.
//
// What an audit may cost is counted in rays, not in seconds, so that results are the same on any machine. Its unit is a ray of a path among
// few polygons, about .3 microseconds; where rays are dearer there are fewer of them: how dear, some paths from the points that are audited
// tell (SurfaceErrorMeter::ray_price). Pilots are part of it:
//   an audit without a target    about as much time as what it judges, the solution and of a picture that, too, but at least 5000 rays a
//                                point (three seconds for 2000 points) and at most 120 million; past half of it only where the interval
//                                comes out wider than the error itself, and would become narrow by that
//   of a round to a target       as much as the solution of the round was worth
//   that is to show the target   twice as much, or rays_that_show where that is more; only when its pilot finds the target met. A pilot
//                                that finds it missed after all is followed by an audit of about its own size
// What a point costs is known from the pilot alone: where few points see light, to a quarter. Beyond that goes only the least that gives an
// interval: a quarter of the points, with four paths for each of two estimates.
//
// Where the interval came out too wide, or leaves open a target that seems to be met, that audit becomes the pilot of another one, and is
// reported no more: both together would lean to the side that made the first one so.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>

namespace radiosity {

// The largest power of the fourth root of 2 that is at most x, which is positive. Numbers of points, and the shares of the rays that they
// may take, are such ones: other casters and compilers find some rays elsewhere, at edges, and an audit of one point more draws all of its
// points anew.
[[nodiscard]] inline double steady(double x) { return std::exp2(std::floor(4.0 * std::log2(x)) / 4.0); }

struct AuditGoal {
  std::uint64_t points = 2000;      // about: a quarter of them at least, more where the points differ much
  std::uint64_t rays = 0;           // at most, pilots included, unless the least number of points takes more; as dear as among few polygons
  std::optional<double> wanted{};   // relative L2 that is to be shown, or shown to be missed; else the error is to be known to a quarter
  std::uint64_t rays_to_show = 0;   // at most when the pilot finds the error to be what is wanted: that is then all that is left to do
  std::uint64_t rays_anyhow = 0;    // at least: a pilot may have met the few points that matter by chance, or missed them
  std::uint64_t rays_if_wide = 0;   // at most, more than all that, when the interval comes out wider than the error that it is of
  std::uint64_t rays_to_steer = 0;  // at most, for what decides how to refine further: it must not depend on what is wanted

  // The same where a ray costs `work` times as much (raycast::Scene::ray_work).
  [[nodiscard]] AuditGoal among_rays_of(double work) const {
    const double part = steady(1.0 / work);
    const auto fewer = [part](std::uint64_t count) { return static_cast<std::uint64_t>(static_cast<double>(count) * part); };
    return {points, fewer(rays), wanted, fewer(rays_to_show), fewer(rays_anyhow), fewer(rays_if_wide), fewer(rays_to_steer)};
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

inline constexpr std::uint64_t rays_to_know_a_point = 5000;

// The microseconds of a ray of a path among few polygons, in which the rays of an AuditGoal are counted.
inline constexpr double microseconds_of_ray = 0.3;

// About what a picture in gathered light took, in the same unit as rays_worth. `price`: raycast::Scene::ray_work + walk_work.
[[nodiscard]] inline std::uint64_t picture_worth(double price, std::uint32_t width, std::uint32_t height) {
  constexpr double rays_a_pixel = 4.0;
  return static_cast<std::uint64_t>(rays_a_pixel * price * width * height);
}

// What an audit without a target may take in all, of a solution, and of a picture worth `picture`: as long as both took. A link takes as
// long as three rays of paths at least, and so does a ray of a picture.
[[nodiscard]] inline std::uint64_t most_rays_to_know(const Audit& audit, std::uint32_t points, std::uint64_t picture = 0) {
  constexpr std::uint64_t most = 120'000'000;
  const std::uint64_t least = rays_to_know_a_point * points;
  return std::clamp<std::uint64_t>(3 * (rays_worth(audit) + picture), least, std::max(most, least));
}

[[nodiscard]] inline AuditGoal goal_to_know(const Audit& audit, std::uint32_t points, std::uint64_t picture = 0) {
  const std::uint64_t half = most_rays_to_know(audit, points, picture) / 2;
  return {points, half, {}, 0, std::min(half, rays_worth(audit)) / 2, half};
}

// For the audit of a round to a target. A quarter is left for what steers the next round.
[[nodiscard]] inline AuditGoal goal_of_round(const Audit& audit, std::uint32_t points, double wanted) {
  constexpr std::uint64_t rays_that_show = 4'000'000;
  const std::uint64_t worth = rays_worth(audit);
  AuditGoal goal{points, 3 * worth / 4, wanted, std::max(rays_that_show, 2 * worth)};
  goal.rays_to_steer = worth / 4;
  return goal;
}

namespace detail {

// What the pilots say about the audit that follows them.
struct Effort {
  std::uint64_t points = 0;  // of the audit, or of the next pilot
  std::uint32_t paths = 4;
  bool pilot = true;  // another one is needed
  bool light = true;  // was any found?
};

// `seen`, `rays`: of a pilot of so many points and paths; `spent`: by all pilots so far. `met`: points that count.
[[nodiscard]] Effort next_effort(const AuditGoal& goal, std::uint64_t least, const Effort& pilot, const ErrorSums& seen, std::uint64_t rays,
                                 std::uint64_t spent);

// What makes the interval of an audit narrow, for what is left of rays and rays_if_wide; or shows a target that the audit found met but did
// not show, for what is left of rays and rays_to_show. Nothing where the audit does as it is, or where that would hardly be reached.
// `rays`: of that audit; `spent`: with all pilots.
[[nodiscard]] std::optional<Effort> further_effort(const AuditGoal& goal, const Effort& audit, const ErrorSums& sums, std::uint64_t rays,
                                                   std::uint64_t spent);

}  // namespace detail

// `measure(points, paths, result)` adds that many fresh points to the result and returns false when it was cancelled; a Measured has
// `rays`, and `sums(measured)` are those that matter. False when it was cancelled: the result then has no meaning. Where no pilot finds
// light nothing is measured, for there is nothing to be wrong about.
template <class Measured>
[[nodiscard]] bool measure_to_goal(const std::function<bool(std::uint64_t points, std::uint32_t paths, Measured&)>& measure,
                                   const std::function<const ErrorSums&(const Measured&)>& sums, const AuditGoal& goal, Measured& result) {
  constexpr std::uint64_t rays_a_path = 8;  // about
  const std::uint64_t least = std::max<std::uint64_t>(goal.wanted ? 250 : 16, goal.points / 4);
  detail::Effort effort{std::clamp<std::uint64_t>(goal.points / 8, 16, 512), goal.rays < 2 * 16 * rays_a_path * least ? 4u : 16u};
  std::uint64_t spent = 0;
  while (effort.pilot) {
    Measured pilot;
    if (!measure(effort.points, effort.paths, pilot)) { return false; }
    spent += pilot.rays;
    effort = detail::next_effort(goal, least, effort, sums(pilot), pilot.rays, spent);
  }
  if (!effort.light) { return true; }
  if (!measure(effort.points, effort.paths, result)) { return false; }
  const std::optional<detail::Effort> further = detail::further_effort(goal, effort, sums(result), result.rays, spent + result.rays);
  if (!further) { return true; }
  result = {};
  return measure(further->points, further->paths, result);
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/audit_effort.cpp>
#endif
