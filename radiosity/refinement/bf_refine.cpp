// SPDX-License-Identifier: MIT
#include <radiosity/refinement/bf_refine.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <raycast/inline.hpp>

#include <radiosity/refinement/bf_choice.hpp>
#include <radiosity/refinement/bf_generation.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::size_t Deadline::links_left(std::uint64_t links) const {
  if (!seconds_) { return std::numeric_limits<std::size_t>::max(); }
  constexpr double for_solution = 0.2;
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double left = (1.0 - for_solution) * *seconds_ - spent;
  return left > 0.0 ? static_cast<std::size_t>(left / spent * static_cast<double>(links)) : 0;
}

HALFLIGHT_INLINE BfResult bf_refine(DiscreteScene& scene, const BfGoal& goal) {
  detail::BfState state{scene};
  BfResult& result = state.result;
  if (result.refined.cancelled || result.refined.too_many || result.refined.too_large) { return std::move(result); }
  for (;;) {
    if (!detail::evaluate_generation(state)) { return std::move(result); }
    const detail::BfErrors errors = detail::estimate_errors(state, goal.leaf_part);
    if (detail::is_last(state, errors, goal)) { return detail::finish(state); }
    result.interrupted = scene.control.cancelled();
    if (result.interrupted || result.generations == scene.budget.last_generation) { return detail::finish(state); }
    const std::optional<detail::SplitChoice> choice = detail::choose_splits(state, errors, goal);
    if (!choice) { return detail::finish(state); }
    detail::split(state, errors, *choice, detail::allowed_error(errors, goal));
    ++result.generations;
    if (scene.control.after_generation) { scene.control.after_generation(scene.surfaces); }
    scene.control.report("refine", std::min(1.0, goal.target / result.estimate));
  }
}

}  // namespace radiosity
