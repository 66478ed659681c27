// SPDX-License-Identifier: MIT
#pragma once

// What the linear system knows of light that does not get lost.

#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

// The nodes of the surfaces that lose no light (DiscreteScene::closed), and of the lamps where there are such surfaces.
[[nodiscard]] ClosedNodes closed_nodes(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/closed_nodes.cpp>
#endif
