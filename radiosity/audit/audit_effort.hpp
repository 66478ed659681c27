// SPDX-License-Identifier: MIT
#pragma once

// Decides how many points an audit measures and how many paths it traces at each. An audit that went on until its result looked good
// enough would be biased, because it would stop more often when it errs on the good side. So a small pilot decides the effort, and the
// reported result comes from fresh points whose number was fixed beforehand.
//
// The effort is counted in rays, not in seconds, so that results are the same on any machine. The unit is a path-tracing ray in a scene
// of few polygons, about 0.3 microseconds; where rays cost more, the budget allows fewer of them (their price is measured with some paths
// from the audited points: SurfaceErrorMeter::ray_price). Pilots count as part of the audit. Limits:
//   an audit without a target    about as much time as what it judges (the solution, and for a picture that, too), but at least 5000 rays
//                                a point (three seconds for 2000 points) and at most 120 million; the second half of it is used only if the
//                                interval comes out wider than the error itself and the rays would narrow it
//   a round towards a target     as much as the solution of that round was worth; for a picture, as long as drawing it took, besides
//   confirming the target        twice as much, but for the solution at least rays_that_show; only if the pilot finds the target met. If a
//                                second pilot then finds it missed, an audit of about the size of that pilot follows. More than that,
//                                from a reserve that all rounds share, where that is likely to confirm the target for less than the next
//                                round and its audit take, or, while noise hides the error, than four times that round: a finer solution
//                                moves the error away from the target, but the noise of the paths stays, and hides the error as before
//   a target missed in the end   as an audit without a target, once more from fresh points, for a picture; so a target is met by chance
//                                about twice as often as the interval says
// The price of a point is known from the pilot alone, to about a quarter where few points receive light. The budget is exceeded only by
// the minimum that gives an interval at all: a quarter of the points, with four paths for each of two estimates.
//
// If the interval comes out too wide, or does not decide about a target that seems to be met, that audit serves as the pilot of another
// one and is no longer reported: a result merged from both would be biased the way the first one was.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>

namespace radiosity {

// The largest power of the fourth root of 2 that is at most x; x must be positive. Numbers of points and of rays are rounded to such
// values because other ray casters and compilers find a few rays different at edges, and an audit with one point more would draw all of
// its points anew.
[[nodiscard]] inline double steady(double x) { return std::exp2(std::floor(4.0 * std::log2(x)) / 4.0); }

struct AuditGoal {
  std::uint64_t points = 2000;      // approximate number of points: at least a quarter of it, more when the points differ much
  std::uint64_t rays = 0;           // limit including pilots, unless the least number of points takes more
  std::optional<double> wanted{};   // relative L2 error to confirm or refute; when absent, the error is measured to a quarter of itself
  std::uint64_t rays_to_show = 0;   // larger limit when the pilot finds the error at most `wanted`: the confirmation is then the last step
  std::uint64_t rays_anyhow = 0;    // at least as many: a pilot may have met the few points that matter by chance, or missed them
  std::uint64_t rays_if_wide = 0;   // additional limit when the interval comes out wider than the error itself
  std::uint64_t rays_to_steer = 0;  // limit of the measurement that plans the next round; independent of `wanted`
  // Rays that may be taken beyond rays_to_show, to confirm `wanted` where that is likely to take less than to refine first; and how many
  // rays the next round takes, as long as its solution and its picture.
  std::uint64_t reserve = 0, rays_to_refine = 0;

  // The same goal when a ray costs `work` times as much (raycast::Scene::ray_work).
  [[nodiscard]] AuditGoal among_rays_of(double work) const {
    const double part = steady(1.0 / work);
    const auto fewer = [part](std::uint64_t count) { return static_cast<std::uint64_t>(static_cast<double>(count) * part); };
    return {
        points,         fewer(rays),          wanted, fewer(rays_to_show), fewer(rays_anyhow), fewer(rays_if_wide), fewer(rays_to_steer),
        fewer(reserve), fewer(rays_to_refine)};
  }

  // The goal of a round towards a target when a picture worth `picture` is judged: its audit may take as long as that took, too.
  [[nodiscard]] AuditGoal and_picture(std::uint64_t picture) const;
};

// A link, or a ray of a picture, takes as long as so many path-tracing rays at least.
inline constexpr std::uint64_t rays_a_work = 3;

inline AuditGoal AuditGoal::and_picture(std::uint64_t picture) const {
  AuditGoal goal = *this;
  goal.rays += rays_a_work * picture;
  goal.rays_to_show += 2 * rays_a_work * picture;
  goal.rays_to_refine += rays_a_work * picture;
  return goal;
}

// Number of points by which rounds are planned (Audit::steering_error); below, the number of paths at each.
inline constexpr std::uint64_t steering_points = 256;
[[nodiscard]] inline std::uint32_t steering_paths(const AuditGoal& goal) {
  constexpr std::uint64_t rays_a_path = 8;  // about
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(goal.rays_to_steer / (2 * steering_points * rays_a_path), 4, 256));
}

// The time of the solution expressed in path-tracing rays, or somewhat less: among few polygons, a link takes at least as long as such a
// ray. A shadow ray of a link takes an eighth of it in any scene, because it is a finite segment, is cast in a bundle of sixteen, and may
// stop at any blocker.
[[nodiscard]] inline std::uint64_t rays_worth(const Audit& audit) {
  return audit.links + static_cast<std::uint64_t>(audit.ray_work * static_cast<double>(audit.rays) / 8.0);
}

inline constexpr std::uint64_t rays_to_know_a_point = 5000;

// Microseconds of one path-tracing ray among few polygons, the unit in which an AuditGoal counts rays.
inline constexpr double microseconds_of_ray = 0.3;

// Approximate time of a picture in gathered light, in the unit of rays_worth. `price`: raycast::Scene::ray_work + walk_work.
[[nodiscard]] inline std::uint64_t picture_worth(double price, std::uint32_t width, std::uint32_t height) {
  constexpr double rays_a_pixel = 4.0;
  return static_cast<std::uint64_t>(rays_a_pixel * price * width * height);
}

// Ray limit of an audit without a target, for a solution and a picture worth `picture`: as long as both took.
[[nodiscard]] inline std::uint64_t most_rays_to_know(const Audit& audit, std::uint32_t points, std::uint64_t picture = 0) {
  constexpr std::uint64_t most = 120'000'000;
  const std::uint64_t least = rays_to_know_a_point * points;
  return std::clamp<std::uint64_t>(rays_a_work * (rays_worth(audit) + picture), least, std::max(most, least));
}

[[nodiscard]] inline AuditGoal goal_to_know(const Audit& audit, std::uint32_t points, std::uint64_t picture = 0) {
  const std::uint64_t half = most_rays_to_know(audit, points, picture) / 2;
  return {points, half, {}, 0, std::min(half, rays_worth(audit)) / 2, half};
}

// For the audit of a round towards a target. A quarter of the rays is reserved for the measurement that plans the next round. `reserve`:
// see AuditGoal.
[[nodiscard]] inline AuditGoal goal_of_round(const Audit& audit, std::uint32_t points, double wanted, std::uint64_t reserve = 0) {
  constexpr std::uint64_t rays_that_show = 4'000'000;
  const std::uint64_t worth = rays_worth(audit);
  AuditGoal goal{points, 3 * worth / 4, wanted, std::max(rays_that_show, 2 * worth)};
  goal.rays_to_steer = worth / 4;
  goal.reserve = reserve;
  goal.rays_to_refine = rays_a_work * 2 * worth;  // a round mostly takes about twice the work of the one before it
  return goal;
}

// What an audit of `rays` has taken from the reserve of the goal; both in rays of the same cost.
[[nodiscard]] inline std::uint64_t used_of_reserve(const AuditGoal& goal, std::uint64_t rays) {
  return rays - std::min(rays, std::max(goal.rays, goal.rays_to_show));
}

namespace detail {

// What the pilots say about the audit that follows them.
struct Effort {
  std::uint64_t points = 0;  // of the audit, or of the next pilot
  std::uint32_t paths = 4;
  bool pilot = true;  // is another pilot needed?
  bool light = true;  // did any point receive light?
};

// `seen`, `rays`: result and rays of the pilot `pilot`; `spent`: rays of all pilots so far; `least`: least number of points.
[[nodiscard]] Effort next_effort(const AuditGoal& goal, std::uint64_t least, const Effort& pilot, const ErrorSums& seen, std::uint64_t rays,
                                 std::uint64_t spent);

// A further audit that makes the interval narrow within the unspent part of rays and rays_if_wide; or one that confirms, within the
// unspent part of rays and rays_to_show, a target that the audit found met but could not confirm. Nothing when the audit suffices or this
// could hardly be reached. `rays`: rays of that audit; `spent`: with all pilots.
[[nodiscard]] std::optional<Effort> further_effort(const AuditGoal& goal, const Effort& audit, const ErrorSums& sums, std::uint64_t rays,
                                                   std::uint64_t spent);

}  // namespace detail

// `measure(points, paths, result)` adds that many fresh points to the result and returns false when cancelled. A Measured has a member
// `rays`; `sums(measured)` returns the sums that the goal refers to. Returns false when cancelled; the result then has no meaning. If no
// pilot finds light, nothing is measured, because there is no error.
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
