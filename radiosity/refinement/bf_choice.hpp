// SPDX-License-Identifier: MIT
#pragma once

// Chooses the links and leaves that a generation of BF-refinement splits: those with the largest errors, until the others would meet the
// target, within the limits of time, memory and links.

#include <optional>

#include <radiosity/refinement/bf_generation.hpp>
#include <radiosity/refinement/bf_goal.hpp>

namespace radiosity {

namespace detail {

// The sum of squared errors that may remain; 0 if a time limit ends the refinement.
[[nodiscard]] double allowed_error(const BfErrors& errors, const BfGoal& goal);

// Does the solution meet the goal, or is the limit of links exceeded?
[[nodiscard]] bool is_last(const BfState& state, const BfErrors& errors, const BfGoal& goal);

// Nothing if no split is left that helps and fits. If choices do not fit in memory, result.too_large keeps what the largest one needs.
[[nodiscard]] std::optional<SplitChoice> choose_splits(BfState& state, const BfErrors& errors, const BfGoal& goal);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_choice.cpp>
#endif
