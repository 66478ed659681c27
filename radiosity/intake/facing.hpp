// SPDX-License-Identifier: MIT
#pragma once

// Pieces of solids that no topology can tell the outside of. Where boxes stand on each other and share a face, of each box a tube without
// a lid is left, and its winding may be anything. Such pieces look to the side that the light reaches (side_light.hpp); then the faces
// around an edge tell again which of them bound one solid (topology.hpp).

#include <span>

#include <radiosity/intake/side_light.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// Faces are oriented (orient). Asks pieces that have a border, at least half of which lies on other faces: on their edges, or across them,
// as the ends of a table's leg do that is a tube without ends. Turns those on whose backs at least ten times as much light falls as on
// their fronts. In the dark the longer way to the next surface decides, from twice as long on. Walls around closed things are not turned
// to what is outside of them. Pieces of which this tells the outside are mixed no longer, and what was given for their backs is left out.
// A sheet of which each side was given may look both ways: here only what is as dark as the inside of a solid, a hundred times darker, is
// not seen. A piece at least half of whose border has another face on either side, so that it divides what is around it, gets a back where
// light falls on both of its sides.
void turn_to_light(Working& mesh, std::span<const Material> materials, const IntakeOptions& options);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/facing.cpp>
#endif
