// SPDX-License-Identifier: MIT
#include <radiosity/refinement/bf_refine.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include <brep/inline.hpp>

#include <radiosity/refinement/bf_choice.hpp>
#include <radiosity/refinement/bf_generation.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

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
