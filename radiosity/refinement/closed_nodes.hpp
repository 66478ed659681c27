// SPDX-License-Identifier: MIT
#pragma once

// Tells the linear system which nodes lose no light.

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

// The nodes of surfaces that lose no light (DiscreteScene::closed), and the nodes of lamps. A cluster with a link passes light to all its
// faces. If one of these loses light, as the half of a lamp behind the wall into which it is sunk, the row sums of the others are not
// known, so none of that cluster's nodes is included.
[[nodiscard]] ClosedNodes closed_nodes(const DiscreteScene& scene, const Links& links);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/closed_nodes.cpp>
#endif
