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

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <radiosity/links/evaluate.hpp>
#include <radiosity/oracle/bf_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>

namespace radiosity {

struct BfResult {
  Links links;
  RefineResult refined;
  EvaluateResult evaluated;
  std::uint64_t evaluations = 0;  // of links
  std::uint32_t generations = 0;
  double estimate = 0.0;       // relative L2 error, with this part of the variation over leaves,
  double leaf_estimate = 0.0;  // and with all of it
  double unseen = 0.0;         // share of its square that is due to links through which no segment came
  bool interrupted = false;
  std::uint64_t too_large = 0;  // bytes that a finer solution would have needed, when that was more than the budget allows
};

// Seconds that refinement may take, from some beginning.
class Deadline {
 public:
  explicit Deadline(std::optional<double> seconds) : seconds_{seconds} {}

  // How many links can be evaluated in what is left, when `links` were until now; the last solution takes its part.
  [[nodiscard]] std::size_t links_left(std::uint64_t links) const;
  [[nodiscard]] bool limited() const { return seconds_.has_value(); }

 private:
  std::optional<double> seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The estimated relative error, with `leaf_part` of the variation over leaves (leaf_error.hpp), is to be at most `target`, or, with a
// limit, as small as the deadline allows.
struct BfGoal {
  double target = 0.0;
  double leaf_part = 1.0;
  Deadline deadline;
  AnyOracle oracle = BfOracle{};  // about links with large errors
};

// Makes evaluated links, and leaves, that meet the goal. Stops before when there is nothing left to split, at 2^-24 of the scene's area,
// or when there would be more links than `link_limit` or more memory would be needed than the budget allows.
// Exposure, and what the clusters show of it, grow with the hierarchy.
[[nodiscard]] BfResult bf_refine(DiscreteScene& scene, const BfGoal& goal);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_refine.cpp>
#endif
