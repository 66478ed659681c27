// SPDX-License-Identifier: MIT
#pragma once

// The pairs with which F-refinement begins (f_refine.hpp).

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/proof_oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/refine_result.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity::detail {

// Nodes without a parent.
[[nodiscard]] std::vector<std::uint32_t> tops(const Hierarchy& hierarchy);

// Adds the pair of the root cluster with itself, or all pairs of input faces. `result.inner` receives the input faces whose parts may
// face each other.
void first_pairs(const DiscreteScene& scene, const ProofOracle& proofs, Linked linked, NodePairs& pairs, RefineResult& result);

}  // namespace radiosity::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/first_pairs.cpp>
#endif
