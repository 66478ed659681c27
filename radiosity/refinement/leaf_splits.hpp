// SPDX-License-Identifier: MIT
#pragma once

// Splits leaves by their light after F-refinement, once the links are evaluated: where the light varies over them, near lamps, in corners
// and on curved objects. The links stay at the former leaf, which becomes an inner node and passes their light down by its gradient
// (links.hpp, bend.hpp). So leaves become finer without further links or rays.
//
// A leaf i whose irradiance has the gradient g_i is split if the error of its constant (leaf_error.hpp) satisfies
//
//     A_i rho^2 (mean over i of (g_i . (x - c_i))^2)  >  (light_epsilon / 4)^2 * (what the scene reflects, squared, over its area)
//
// Its children are split again if their share of that error (1/16 for a quarter of the area) is still above: two levels at most, because
// the gradient is only the linear part of the light. The light is that of coarse_light.hpp. Links between two leaves have no gradients
// yet; they get them if an upper bound says that the leaf may be split. A gradient does not show where a shadow ends within a leaf.
//
// Partly buried leaves are not split, because links cannot tell which of their children are exposed; nor are leaves at blades.

#include <cstdint>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

struct LeafSplitRule {
  double light_epsilon = 0.0;
  double min_area = 0.0;  // least area of a leaf that is split, relative to the area of the input faces that are not buried
};

struct LeafSplits {
  std::uint64_t count = 0;      // leaves that were split
  std::uint64_t too_large = 0;  // bytes needed, if that exceeded the budget; then nothing was split
};

// Splits leaves and exposes the new ones. Links at split leaves get their gradients and are adapted to the areas, which are known better
// now; `doubt` receives the variation over the children that they cannot express. Splits nothing after cancellation.
[[nodiscard]] LeafSplits split_leaves_by_light(DiscreteScene& scene, Links& links, const LeafSplitRule& rule, DoubtSum& doubt);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/leaf_splits.cpp>
#endif
