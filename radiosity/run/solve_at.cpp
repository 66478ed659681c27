// SPDX-License-Identifier: MIT
#include <radiosity/run/solve_at.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/out_of_memory.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/memory.hpp>

namespace radiosity {

namespace detail {

// One run at a given fineness. `budget`: with the limits set; the fixed memory of the run is added later.
HALFLIGHT_INLINE Outcome solve_at(const Scene& scene, const Options& options, const Control& control, const MemoryBudget& budget) {
  Run run{scene, options, control, budget};
  for (const auto next : {stage::build, stage::refine, stage::expose, stage::link, stage::solve, stage::compare_matrix, stage::reconstruct,
                          stage::compare_picture, stage::refine_mesh, stage::summarise, stage::audit}) {
    if (std::optional<Failure> failure = next(run)) { return {std::nullopt, std::move(*failure)}; }
  }
  return run.finish();
}

// Makes BF-refinement end one generation earlier; returns false if that is not possible.
[[nodiscard]] HALFLIGHT_INLINE bool end_before(MemoryBudget& budget, std::uint32_t solved) {
  if (budget.last_generation == 0) { return false; }
  budget.last_generation = std::min(budget.last_generation, solved) - 1;
  return true;
}

// Makes F-refinement produce about half as many links; returns false if the thresholds cannot be larger.
[[nodiscard]] HALFLIGHT_INLINE bool coarsen(Options& options) {
  if (options.epsilon >= 1.0) { return false; }
  constexpr double step = 1.5;
  options.epsilon *= step;
  options.min_area *= step * step;
  if (options.light_epsilon) { *options.light_epsilon *= step; }
  return true;
}

HALFLIGHT_INLINE void tell_shortage(Audit& audit, const Failure& failure, const std::vector<StageTime>& lost) {
  std::vector<StageTime> stages;
  add_times(stages, lost);
  add_times(stages, audit.stages);
  audit.stages = std::move(stages);
  audit.shortage = failure.sentences.empty() ? "the system had no more memory for a finer solution" : failure.sentences.front();
  audit.converged = false;
  sum_times(audit);
}

HALFLIGHT_INLINE Outcome solve_within_memory(const Scene& scene, const Options& options, const Control& control, std::uint64_t held) {
  MemoryBudget budget;
  budget.arrays = options.arrays;
  const std::optional<std::uint64_t> allowed = options.allowed_memory();
  if (allowed) { budget.allowed = *allowed - std::min(*allowed, held); }
  budget.by_default = allowed && !options.memory;
  std::uint32_t solved = 0;
  budget.solved = &solved;
  std::vector<StageTime> lost;
  Stopwatch watch{lost};
  Outcome outcome = unless_out_of_memory([&] { return solve_at(scene, options, control, budget); });
  Options coarser = options;
  const Failure first = outcome.failure;
  while (!outcome.solution && outcome.failure.kind == Failure::Kind::out_of_memory && solved > 0) {
    const bool possible = options.refinement == Refinement::a_posteriori ? end_before(budget, solved) : held == 0 && coarsen(coarser);
    if (!possible) { break; }
    solved = 0;
    outcome = unless_out_of_memory([&] {
      watch.lap("lost for want of memory");
      Outcome again = solve_at(scene, coarser, control, budget);
      if (again.solution) {
        tell_shortage(again.solution->audit, first, lost);
        again.solution->audit.coarsened = options.refinement == Refinement::a_priori;
      }
      return again;
    });
  }
  return outcome;
}

}  // namespace detail

}  // namespace radiosity
