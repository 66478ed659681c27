// SPDX-License-Identifier: MIT
#pragma once

// Which links and leaves a generation of BF-refinement splits: those with the largest errors, until those of the rest would meet the
// target, as far as time, memory and the limit of links allow.

#include <optional>

#include <radiosity/refinement/bf_generation.hpp>
#include <radiosity/refinement/bf_goal.hpp>

namespace radiosity {

namespace detail {

// The sum of squared errors that may remain; 0 when a time limit ends the refinement.
[[nodiscard]] double allowed_error(const BfErrors& errors, const BfGoal& goal);

// Does the solution meet the goal, or are there more links than there may be?
[[nodiscard]] bool is_last(const BfState& state, const BfErrors& errors, const BfGoal& goal);

// Nothing when no split is left that helps and fits. The result keeps how much memory the largest of the choices that do not fit needs.
[[nodiscard]] std::optional<SplitChoice> choose_splits(BfState& state, const BfErrors& errors, const BfGoal& goal);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_choice.cpp>
#endif
