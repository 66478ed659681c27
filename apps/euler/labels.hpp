// SPDX-License-Identifier: MIT
#pragma once

// Places and sizes for the names in a panel.
//
// The room of a face is the radius of the largest circle in it; letters are small where there is little. Names of half-edges stand
// beside the middle of their edge, names of faces where the way to all lines, vertices and other names is longest.

#include "apps/euler/layout.hpp"

namespace apps::euler {

// Needs the strands, vertices and areas of the panel; fills in the rest. `smallest` is the least size of letters.
void place_names(const PlanarMap& map, std::uint32_t outer, double smallest, Panel& panel);

}  // namespace apps::euler
