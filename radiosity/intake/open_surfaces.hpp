// SPDX-License-Identifier: MIT
#pragma once

// Open surfaces in models whose file does not say which of their sides are seen: a terrain, a cloth, a leaf, a cup without thickness.
// About half of them have their backs towards the viewer, so they are made to reflect on both sides. Exception: the walls of a room with
// an opening, because such a room is viewed through the backs of its front walls. Things that stand in a room are no walls, whether the
// room is open or closed.

#include <radiosity/intake/shells.hpp>
#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// To be called when the roles are known. A surface whose opening is less than a fiftieth of its area keeps its one side, because hardly
// anything is seen through the opening. So does a surface whose border mostly lies on others, as with the cells of a solid that was cut
// into pieces. If `may_turn`, a single surface that looks inwards and does not emit there is turned, like a closed shell with nothing in
// it.
void show_both_sides(Working& mesh, const Topology& topology, bool may_turn, Shells& shells);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/open_surfaces.cpp>
#endif
