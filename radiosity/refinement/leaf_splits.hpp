// SPDX-License-Identifier: MIT
#pragma once

// The last split of leaves, by the light: after F-refinement, once their links are evaluated, leaves are split where the light varies over
// them, near lamps, in corners and on curved objects. The links stay at what was the leaf, which is now an inner node and hands their light
// down by its gradient (links.hpp, bend.hpp). So leaves become finer without more links and without more rays.
//
// A leaf i with the gradient g_i of its irradiance is split when by its constant (leaf_error.hpp)
//
//     A_i rho^2 (mean over i of (g_i . (x - c_i))^2)  >  (light_epsilon / 4)^2 * (what the scene reflects, squared, over its area)
//
// and its children again when their share of that, 1/16 for a quarter of the area, is still above: two levels at most, for the gradient is
// only the linear part of the light. The light is that of coarse_light.hpp. The links between two leaves have no gradients yet; they get
// them where a bound says that the leaf may be split. A gradient does not show where within a leaf a shadow ends.
//
// Leaves that are partly buried stay whole, because links could not tell what is exposed of their children, and so do leaves at blades.

#include <cstdint>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

struct LeafSplitRule {
  double light_epsilon = 0.0;
  double min_area = 0.0;  // of a leaf that is split, at least, relative to the area of the input faces that are not buried
};

struct LeafSplits {
  std::uint64_t count = 0;      // leaves that were split
  std::uint64_t too_large = 0;  // bytes that would be needed when that is more than the budget allows; nothing was split then
};

// Splits leaves and exposes what is new. Links at them get their gradients, and are fitted to areas that are known better now; `doubt` gets
// what they cannot express over the children. Nothing is split once the run was cancelled.
[[nodiscard]] LeafSplits split_leaves_by_light(DiscreteScene& scene, Links& links, const LeafSplitRule& rule, DoubtSum& doubt);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/leaf_splits.cpp>
#endif
