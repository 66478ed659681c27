// SPDX-License-Identifier: MIT

// Stage: splits patches and chooses links (paper 4.3, 4.4).

#include <cstdint>
#include <optional>
#include <utility>

#include <brep/inline.hpp>

#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/refinement/bf_refine.hpp>
#include <radiosity/refinement/link_error.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/f_refinement.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/memory.hpp>

namespace radiosity {

namespace detail {

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
    if (budget.solved != nullptr) { *budget.solved = 1; }
    detail::refine_by_forms(run);
    if (budget.solved != nullptr && run.refined.pairs_tested == 0) { *budget.solved = 0; }  // even the input faces alone are too many
    if (run.refined.cancelled && run.refined.generations > 0) { detail::refine_coarsely(run); }
  } else if (!budget.allows({run.scene.hierarchy.size()})) {
    run.refined.too_large = budget.peak({run.scene.hierarchy.size()});
  }
  if (std::optional<Failure> failure = detail::refusal(run)) { return failure; }
  run.watch.lap("refine");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
