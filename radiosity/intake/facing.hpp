// SPDX-License-Identifier: MIT
#pragma once

// Finds the outside of pieces of solids for which topology alone does not determine it. Where boxes stand on each other and share a face,
// each box loses that face and becomes a tube whose winding may be anything. The front of such a piece is the side that light reaches
// (side_light.hpp). After that, the faces around an edge determine again which of them bound one solid (topology.hpp).

#include <span>

#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// Requires oriented faces (orient). Examines pieces with a border, at least half of which lies on other faces: on their edges or across
// them, as do the ends of a table leg without end faces. Turns pieces whose backs receive at least ten times as much light as their
// fronts; in the dark, the side with at least twice the distance to the next surface becomes the front. Walls around closed objects are not
// turned to the outside. Pieces that are decided in this way are no longer marked as mixed, and polygons given for their backs are removed.
// A sheet with polygons for both sides may be visible from both: only a side a hundred times darker, like the inside of a solid, is
// removed, and neither side of a lamp. A polygon that is turned onto another one is removed, not the other. A piece that divides its
// surroundings, with other faces on both sides along at least half of its border, gets a back if light falls on both of its sides.
void turn_to_light(Working& mesh, std::span<const Material> materials, const IntakeOptions& options);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/facing.cpp>
#endif
