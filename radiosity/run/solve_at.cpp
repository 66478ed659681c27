// SPDX-License-Identifier: MIT
#include <radiosity/run/solve_at.hpp>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <utility>

#include <raycast/inline.hpp>

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

// One run at a given fineness. `budget`: its limits are set; what the run takes anyhow becomes known later.
HALFLIGHT_INLINE Outcome solve_at(const Scene& scene, const Options& options, const Control& control, const MemoryBudget& budget) {
  Run run{scene, options, control, budget};
  for (const auto next : {stage::build, stage::refine, stage::expose, stage::link, stage::solve, stage::compare_matrix, stage::reconstruct,
                          stage::compare_picture, stage::refine_mesh, stage::summarise, stage::audit}) {
    if (std::optional<Failure> failure = next(run)) { return {std::nullopt, std::move(*failure)}; }
  }
  return run.finish();
}

HALFLIGHT_INLINE Outcome solve_within_memory(const Scene& scene, const Options& options, const Control& control, std::uint64_t held) {
  MemoryBudget budget;
  budget.arrays = options.arrays;
  if (options.memory) { budget.allowed = *options.memory - std::min(*options.memory, held); }
  std::uint32_t solved = 0;  // generations of BF-refinement
  budget.solved = &solved;
  Outcome outcome = unless_out_of_memory([&] { return solve_at(scene, options, control, budget); });
  while (!outcome.solution && outcome.failure.kind == Failure::Kind::out_of_memory && solved > 0 && budget.last_generation > 0) {
    budget.last_generation = std::min(budget.last_generation, std::exchange(solved, 0)) - 1;
    outcome = unless_out_of_memory([&] {
      Outcome coarser = solve_at(scene, options, control, budget);
      if (coarser.solution) {
        coarser.solution->audit.shortage = "the system had no more memory for a finer solution; a larger target or error needs less";
        coarser.solution->audit.converged = false;
      }
      return coarser;
    });
  }
  return outcome;
}

}  // namespace detail

}  // namespace radiosity
