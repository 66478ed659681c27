// SPDX-License-Identifier: MIT

// Stage: measures the error of the solution by path tracing (audit/).

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include <brep/inline.hpp>

#include <radiosity/audit/aimed_paths.hpp>
#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/surface_error.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

namespace detail {

// Sets the errors of the solution, whose meshes are still in the frame.
HALFLIGHT_INLINE void measure_errors(Run& run) {
  const Options& options = run.options;
  const Control& control = run.scene.control;
  const Solution& solution = run.solution;
  Audit& audit = run.solution.audit;
  SurfaceErrorMeter meter{run.scene, *run.tracer, solution.shown(), run.direct ? &*run.direct : nullptr, options.seed};
  audit.ray_work = run.scene.objects.ray_work() + run.scene.objects.walk_work();
  const AuditGoal to_know = goal_to_know(audit, options.audit_points);
  AuditGoal goal = options.error ? goal_of_round(audit, options.audit_points, *options.error, options.audit_reserve) : to_know;
  if (options.error && control.picture_error) {
    Mesh shown = solution.mesh;
    to_scene(shown, solution.frame);
    audit.picture_error = control.picture_error(shown, solution.frame, goal);
    // If the picture decides, the error over all surfaces needs little effort until the picture is good enough.
    const bool last = audit.picture_error && audit.picture_error->error.within(*options.error);
    goal = last ? to_know : AuditGoal{options.audit_points / 4, rays_worth(audit) / 4};
  }
  // Aiming affects what plans the next round, so whether it is tried must not depend on the target.
  const AuditGoal any_target{0, options.error ? rays_worth(audit) : to_know.rays};
  if (any_target.among_rays_of(audit.ray_work).rays >= least_rays_to_aim) {
    audit.audit_rays += meter.aim(run.scene.surfaces, run.scene.threads);
  }
  const double price = meter.ray_price();
  audit.ray_price = price > 0.0 ? price / microseconds_of_ray : audit.ray_work;
  goal = goal.among_rays_of(audit.ray_price);
  const bool reconstructed = options.reconstruction != Reconstruction::none;
  const auto sums = [&](const SurfaceError& error) -> const ErrorSums& { return reconstructed ? error.reconstructed : error.leaf; };
  const auto measure = [&](std::uint64_t points, std::uint32_t paths, SurfaceError& to) {
    const std::uint64_t before = to.rays;
    const bool complete = meter.measure(points, paths, run.scene.threads, control, to);
    audit.audit_rays += to.rays - before;
    return complete;
  };
  if (goal.rays_to_steer > 0) {  // first, so that its points are the same for any target
    SurfaceError steering;
    if (!measure(steering_points, steering_paths(goal), steering)) { return; }
    audit.steering_error = sums(steering).estimate();
    const double direct = std::max(0.0, steering.direct), split = direct + std::max(0.0, steering.other);
    if (split > 0.0) { audit.direct_share = direct / split; }
  }
  SurfaceError measured;
  const std::uint64_t before = audit.audit_rays;
  if (!measure_to_goal<SurfaceError>(measure, sums, goal, measured)) { return; }
  if (goal.reserve > 0) {
    audit.reserve_used =
        static_cast<std::uint64_t>(audit.ray_price * static_cast<double>(used_of_reserve(goal, audit.audit_rays - before)));
  }
  audit.leaf_error = measured.leaf.estimate();
  if (reconstructed) { audit.surface_error = measured.reconstructed.estimate(); }
  audit.audit_points = measured.points();
}

inline constexpr double most_off = 3.0;              // the estimate may differ from the error by this factor
inline constexpr std::uint64_t enough_points = 250;  // of an audit; fewer may miss what matters, or meet it too often

// Has path tracing found that the error is larger than the estimate allows? A wide interval must not excuse the estimate, so the measured
// error itself decides; but fewer points than `enough_points` may have met a few large errors by chance, and then the interval decides.
[[nodiscard]] HALFLIGHT_INLINE bool refutes(const ErrorEstimate& measured, std::uint64_t points, double estimate) {
  const bool found = measured.low > 0.0 && points >= enough_points;
  return measured.above(most_off * estimate) || (found && measured.relative_l2 > most_off * estimate);
}

// A sentence if the error found by path tracing differs from the links' estimate by more than a factor of three. If noise hides the error
// only the upper end of its interval is used.
[[nodiscard]] HALFLIGHT_INLINE std::string contradiction(double estimate, const ErrorEstimate& measured, std::uint64_t points) {
  const bool found = measured.low > 0.0, low = refutes(measured, points, estimate);
  const double error = found ? measured.relative_l2 : measured.high;
  const bool high = points >= enough_points && estimate > most_off * error;  // fewer may miss what matters
  if (!low && !high) { return {}; }
  char text[80] = "";
  std::snprintf(text, sizeof text, "%s: path tracing found %s%.3g %%", low ? "no bound" : "too high", found ? "" : "at most ",
                100.0 * error);
  return text;
}

// Compares the errors found by path tracing with those estimated from the links. The estimate is for the light of the links, so it is not
// compared with the error of a mesh in gathered light. If no accuracy was asked for, the estimate is the only claim of the run; so if it is
// refuted, the run has not converged.
HALFLIGHT_INLINE void compare_with_estimate(Run& run) {
  Audit& audit = run.solution.audit;
  std::string found;
  bool refuted = false;
  const auto compare = [&](const std::optional<double>& estimate, const std::optional<ErrorEstimate>& measured) {
    if (!estimate || !measured) { return; }
    if (found.empty()) { found = contradiction(*estimate, *measured, audit.audit_points); }
    refuted = refuted || refutes(*measured, audit.audit_points, *estimate);
  };
  if (!run.solution.refined) { compare(audit.estimated_error, audit.surface_error); }
  compare(audit.estimated_leaf_error, audit.leaf_error);
  if (!found.empty()) { audit.estimate_doubt = found; }
  audit.asked = run.options.error.value_or(run.bf_refined() && !run.options.time ? run.options.target : 0.0);
  audit.refuted = audit.converged && refuted && !(audit.asked > 0.0);
  audit.converged = audit.converged && !audit.refuted;
}

// Checks whether BF-refinement has met its target: by the audit, if there is one that can tell, else by its own estimate.
HALFLIGHT_INLINE void check_target(Run& run) {
  Audit& audit = run.solution.audit;
  const std::optional<ErrorEstimate>& error = run.options.reconstruction != Reconstruction::none ? audit.surface_error : audit.leaf_error;
  const double target = run.options.target;
  const bool contradicted = error && error->above(target), confirmed = error && error->within(target);
  audit.target_missed = contradicted || !(confirmed || *audit.estimated_error <= target);
  audit.converged = audit.converged && !audit.target_missed;
}

}  // namespace detail

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> audit(detail::Run& run) {
  const Options& options = run.options;
  const Control& control = run.scene.control;
  const Plan& plan = run.scene.plan;
  Audit& audit = run.solution.audit;
  if (!plan.lit || !plan.reflects) {
    audit.leaf_error = ErrorEstimate{};  // B = E is exact
    if (options.reconstruction != Reconstruction::none) { audit.surface_error = audit.leaf_error; }
    if (control.picture_error) { audit.picture_error = PictureError{}; }
  } else if (options.audit_points > 0 && plan.traceable && !run.stopped()) {
    detail::measure_errors(run);
    detail::compare_with_estimate(run);
    run.watch.lap("audit");
  }
  if (run.bf_refined() && !options.time && !options.error) { detail::check_target(run); }
  if (options.audit_points > 0 && run.needs_links() && plan.traceable && !audit.leaf_error && run.stopped()) {
    audit.interrupted = true;
    audit.left_out.push_back({"the error estimate", "the run was interrupted", ""});
  }
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
