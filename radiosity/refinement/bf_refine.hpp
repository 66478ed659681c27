// SPDX-License-Identifier: MIT
#pragma once

// BF-refinement (paper 4.4): start with a very coarse mesh, solve, refine by the light that links carry, repeat.
//
// The error of a link is estimated from the variation that it cannot express, times the radiosity that it carries (link_error.hpp). In
// each generation the links with the largest errors are replaced by links with the children of the end that contributes most, until the
// estimate meets the target. A leaf whose light varies too much, though linearly, is split alone, and its links stay.
//
// If there are clusters (clusters.hpp) the coarse mesh consists of them: F-refinement opens the link of the root with itself down to
// pairs that lie far enough apart for one direction to represent the other end; so do all pairs below. From then on clusters are opened
// and patches split in the same way, by the light of their links.
//
// A link whose segments were all blocked is kept, with zero light, until it has been split or can no longer matter: a coarse link that
// misses a doorway would otherwise be dropped for good. Its children remember how many segments were blocked before.
//
// Invariants: those of f_refine.hpp. Deterministic: links are evaluated in parallel, everything else is done in the order of the links.

#include <radiosity/refinement/bf_goal.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// Makes evaluated links, and leaves, that meet the goal. Ends earlier if nothing is left to split (leaves of 2^-24 of the scene's area),
// or if more than `link_limit` links or more memory than the budget would be needed. Extends exposure and the clusters' projected areas
// along with the hierarchy.
[[nodiscard]] BfResult bf_refine(DiscreteScene& scene, const BfGoal& goal);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_refine.cpp>
#endif
