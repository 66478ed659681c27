// SPDX-License-Identifier: MIT
#pragma once

// One generation of BF-refinement: its new links are evaluated, the system is solved roughly, the error of each link and leaf is estimated
// from what they carry, and the links and leaves that were chosen (bf_choice.hpp) are replaced by finer ones.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/oracle/proof_oracle.hpp>
#include <radiosity/refinement/bf_goal.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/leaf_error.hpp>
#include <radiosity/refinement/link_error.hpp>

namespace radiosity {

namespace detail {

// What BF-refinement keeps from one generation to the next.
struct BfState {
  // Makes the first, coarse links by F-refinement; they are not evaluated yet. result.refined says when that failed.
  explicit BfState(DiscreteScene& of);

  DiscreteScene& scene;
  ProofOracle proofs;
  BfResult result;
  double min_area = 0.0;          // of a leaf that may still be split
  MeasuredLinks links;            // of now,
  std::size_t measured = 0;       // the first so many of which have been measured
  DoubtSum removed;               // of links that carry nothing
  std::vector<bool> sees_itself;  // nodes whose children will see each other
  std::vector<bool> stuck;        // leaves that the BRep refused to split
};

// The estimated errors of one solution, squared.
struct BfErrors {
  ErrorEstimation links;
  std::vector<float> leaves;  // one a node, with the goal's part of the variation over leaves
  double sum = 0.0;           // of all
};

// What a generation splits (bf_choice.hpp).
struct SplitChoice {
  std::vector<Decision> ends;  // of each link: it stays, or which end is split
  std::vector<bool> asked;     // nodes that are to have children
  std::size_t count = 0;       // links and leaves that are split
};

// Exposes the nodes that are new and evaluates the links that are. False when the run was interrupted before there was any solution.
[[nodiscard]] bool evaluate_generation(BfState& state);

// Solves with the links of now, roughly, and estimates the error of that; the result keeps the estimate of the whole.
[[nodiscard]] BfErrors estimate_errors(BfState& state, double leaf_part);

// Replaces what was chosen. Links that carry no light are removed when all of them together may miss no more than a hundredth of `allowed`.
void split(BfState& state, const BfErrors& errors, const SplitChoice& choice, double allowed);

// The result without the links that were kept for what they might carry.
[[nodiscard]] BfResult finish(BfState& state);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_generation.cpp>
#endif
