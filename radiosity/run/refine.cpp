// SPDX-License-Identifier: MIT

// Stage: patches are split and links chosen (paper 4.3, 4.4).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <raycast/inline.hpp>

#include <radiosity/audit/reflected_light.hpp>
#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/rays/ray_choice.hpp>
#include <radiosity/refinement/bf_refine.hpp>
#include <radiosity/refinement/cluster_choice.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/refinement/link_error.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/plan.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE std::string too_large(const Run& run, std::uint64_t needed) {
  return too_much_memory(needed, run.scene.budget.allowed,
                         run.options.error ? "a larger error needs less"
                         : run.scene.budget.a_posteriori
                             ? "a larger target needs less"
                             : "a larger epsilon or min_area needs less, and BF-refinement ends with the best that fits");
}

// Fineness::reflected for a share of the mean emission that is reflected. By measurement: scenes that are open to the sky keep about what
// they cost, and light through a window, most of it within the edges of a few bright places, is as exact as theirs. Below a hundredth it
// falls as the share does, so that what a lamp sends elsewhere changes nothing.
[[nodiscard]] HALFLIGHT_INLINE double brightness_of_reflected(double share) {
  constexpr double dim = 0.01;
  return std::min(1.0, std::pow(4.0 * std::max(dim, share), 1.25)) * std::min(1.0, share / dim);
}

HALFLIGHT_INLINE void refine_by_forms(Run& run) {
  const Options& options = run.options;
  const Plan& plan = run.scene.plan;
  Audit& audit = run.solution.audit;
  Fineness fineness{options.epsilon, options.min_area, audit.light_epsilon};
  if (options.oracle) { fineness.oracle = options.oracle; }
  if (plan.lit && plan.reflects) {
    run.scene.patches.extend(run.scene.threads);
    audit.reflected_share = reflected_light(run.scene, *run.tracer);
    fineness.reflected = brightness_of_reflected(*audit.reflected_share);
    const bool beside_lamps = *audit.reflected_share > least_share_beside_lamps;
    if (run.rays.few && beside_lamps && !run.clusters.build) { run.rays = RayChoice{true, {}}; }
  }
  run.refined = radiosity::refine(run.scene, fineness, run.rays.cast ? Linked::lamps : Linked::all);
}

HALFLIGHT_INLINE void refine_by_solutions(Run& run) {
  const Options& options = run.options;
  Audit& audit = run.solution.audit;
  BfGoal goal{options.target, leaf_part(options.reconstruction), Deadline{options.time}};
  if (options.oracle) { goal.oracle = options.oracle; }
  BfResult bf = bf_refine(run.scene, goal);
  run.refined = std::move(bf.refined);
  run.solution.links = std::move(bf.links);
  run.evaluated = std::move(bf.evaluated);
  run.unseen = bf.unseen;
  audit.estimated_error = bf.estimate;
  audit.estimated_leaf_error = bf.leaf_estimate;
  audit.target = options.time ? 0.0 : options.target;
  audit.generations = bf.generations;
  audit.interrupted = bf.interrupted;
  if (bf.too_large > 0 && bf.estimate > options.target) { audit.shortage = too_large(run, bf.too_large); }
}

}  // namespace detail

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> refine(detail::Run& run) {
  const Options& options = run.options;
  const Audit& audit = run.solution.audit;
  MemoryBudget& budget = run.scene.budget;
  budget.a_posteriori = options.refinement == Refinement::a_posteriori;
  budget.fixed = run.scene.bytes() + audit.clusters * 8 * direction_count * sizeof(double) + std::uint64_t{options.audit_points} * 150;
  if (run.bf_refined()) {
    detail::refine_by_solutions(run);
  } else if (run.f_refined()) {
    detail::refine_by_forms(run);
  } else if (!budget.allows({run.scene.hierarchy.size()})) {
    run.refined.too_large = budget.peak({run.scene.hierarchy.size()});
  }
  if (run.refined.cancelled || run.evaluated.cancelled) { return detail::cancelled(); }
  if (run.refined.too_many > 0) { return Failure{Failure::Kind::invalid_options, {too_many_links(run.refined.too_many, run.clusters)}}; }
  if (run.refined.too_large > 0) { return Failure{Failure::Kind::out_of_memory, {detail::too_large(run, run.refined.too_large)}}; }
  run.watch.lap("refine");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
