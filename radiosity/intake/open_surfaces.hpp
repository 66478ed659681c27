// SPDX-License-Identifier: MIT
#pragma once

// Open surfaces of a model whose file does not say which of their sides are seen: a terrain, a cloth, a leaf, a cup without thickness. Half
// of them are wound the other way than somebody looks at them. So they reflect on both sides; but not the walls of a room that is open
// somewhere, into which one looks through the backs of those in front.

#include <radiosity/intake/shells.hpp>
#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// To be called when the roles are found. Surfaces whose opening is less than a fiftieth of their area keep their one side: hardly anything
// is seen through it. So do those that mostly end on each other, as the cells of a solid do that was cut into pieces. One that is alone and
// looks inwards, and does not shine there, is turned where `may_turn`, as a closed shell with nothing in it is.
void show_both_sides(Working& mesh, const Topology& topology, bool may_turn, Shells& shells);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/open_surfaces.cpp>
#endif
