// SPDX-License-Identifier: MIT
#pragma once

// What the linear system knows of light that does not get lost.

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

// The nodes of the surfaces that lose no light (DiscreteScene::closed), and of the lamps where there are such surfaces. A cluster that has
// a link hands what arrives to all its faces; where one of these loses light, as the half of a lamp behind the wall that it is sunk
// into, it is not known what the form factors of the others sum up to: none of them is among the nodes.
[[nodiscard]] ClosedNodes closed_nodes(const DiscreteScene& scene, const Links& links);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/closed_nodes.cpp>
#endif
