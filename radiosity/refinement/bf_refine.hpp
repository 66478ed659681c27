// SPDX-License-Identifier: MIT
#pragma once

// BF-refinement (paper 4.4): start with a very coarse mesh, solve, refine by what the links carry, repeat.
//
// The error of a link is estimated from what it cannot express times the radiosity that it carries (link_error.hpp). In each generation
// the links with the largest errors are replaced by those of the children of the end that contributes most, until the estimate
// meets its target. A leaf over which the light varies too much, though linearly, is split by itself: its links stay where they are.
//
// Where there are clusters (clusters.hpp) the coarse mesh is made of them: F-refinement opens the link of their root with itself down to
// pairs that lie apart, so that one direction stands for the other end; all below such a pair lies apart as well. From there on
// clusters are opened and patches split alike, by what their links carry.
//
// A link whose segments were all blocked is kept, with zero light, until it has been split or can no longer matter: a coarse link that
// misses a doorway would otherwise be dropped for good. Its children know how many segments were blocked before.
//
// Invariants: those of f_refine.hpp. Deterministic: links are evaluated in parallel, everything else goes in the order of the links.

#include <radiosity/refinement/bf_goal.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// Makes evaluated links, and leaves, that meet the goal. Stops before when there is nothing left to split, at 2^-24 of the scene's area,
// or when there would be more links than `link_limit` or more memory would be needed than the budget allows.
// Exposure, and what the clusters show of it, grow with the hierarchy.
[[nodiscard]] BfResult bf_refine(DiscreteScene& scene, const BfGoal& goal);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_refine.cpp>
#endif
