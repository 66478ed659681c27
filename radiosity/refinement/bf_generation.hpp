// SPDX-License-Identifier: MIT
#pragma once

// One generation of BF-refinement: its new links are evaluated, the system is solved roughly, the errors of links and leaves are
// estimated from the light that they carry, and the chosen links and leaves (bf_choice.hpp) are replaced by finer ones.

#include <cstddef>
#include <vector>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/oracle/proof_oracle.hpp>
#include <radiosity/refinement/bf_goal.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/link_error.hpp>

namespace radiosity {

namespace detail {

// What BF-refinement keeps from one generation to the next.
struct BfState {
  // Makes the first, coarse links by F-refinement; they are not evaluated yet. If that fails, result.refined says why.
  explicit BfState(DiscreteScene& of);

  DiscreteScene& scene;
  ProofOracle proofs;
  BfResult result;
  double min_area = 0.0;          // of a leaf that may still be split
  MeasuredLinks links;            // current links
  std::size_t measured = 0;       // number of links that have been measured; these come first
  DoubtSum removed;               // errors of removed links, which carried nothing
  std::vector<bool> sees_itself;  // nodes whose children will see each other
  std::vector<bool> stuck;        // leaves that the BRep refused to split
};

// The estimated errors of one solution, squared.
struct BfErrors {
  ErrorEstimation links;
  std::vector<float> leaves;  // by node, weighted with the goal's leaf_part
  double sum = 0.0;           // over all links and leaves
};

// What a generation splits (bf_choice.hpp).
struct SplitChoice {
  std::vector<Decision> ends;  // by link: which end is split, or that it stays
  std::vector<bool> asked;     // nodes that must have children
  std::size_t count = 0;       // number of links and leaves that are split
};

// Exposes the new nodes and evaluates the new links. Returns false if the run was interrupted before there was any solution.
[[nodiscard]] bool evaluate_generation(BfState& state);

// Solves roughly with the current links and estimates the error of that solution; state.result keeps the total.
[[nodiscard]] BfErrors estimate_errors(BfState& state, double leaf_part);

// Replaces the chosen links and leaves. Links without light are removed if all of them together may miss no more than a hundredth of
// `allowed`.
void split(BfState& state, const BfErrors& errors, const SplitChoice& choice, double allowed);

// The result, without links that were kept only because they might carry light.
[[nodiscard]] BfResult finish(BfState& state);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/bf_generation.cpp>
#endif
