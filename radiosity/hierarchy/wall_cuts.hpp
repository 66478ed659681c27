// SPDX-License-Identifier: MIT
#pragma once

// Faces are cut where walls stand on them. A patch carries one radiosity, so a patch that reaches under a wall from one room into the next
// takes light on one side and gives it on the other: light leaks through the wall, the more the larger the patch. Where the flat faces of
// other objects, or of the same open surface, meet a face along about half of a line across it, the face is cut along that line before
// refinement begins (paper 2.2: a split object finds the place, split_plane.hpp). No patch then spans the wall, and what lies under it is a
// patch of its own, buried. Of thin walls that stand on a face along two to twelve lines, 7 % of a line is enough: under a tent
// on a wide ground it may be dark.
//
// In the same way a face is cut along the outline of what lies parallel to it and close before it, as a lamp under a ceiling or a shelf
// before a wall: a patch that reaches out from behind it would take light beside it and send a part of that light to the back of the lamp.
//
// Walls that are shorter than that do not divide a face; refinement finds the shadow at their feet. Invariant: the boundary stays valid,
// each part lies on the sheet of its face.

#include <cstddef>
#include <string>
#include <vector>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Cuts the faces of flat objects, before any refinement. Objects of which more than ten million pairs of faces would have to be looked at
// are left alone, and so are those that are covered by a duplicate. Time: pairs of objects whose bounds come close to each other, of which
// no more than `most_pairs` are looked at, and pairs of their faces. Returns how many objects were left whole because of either limit.
std::size_t cut_at_walls(std::vector<Surface>& surfaces, double diameter, std::size_t most_pairs = 30'000'000);

// What cut_at_walls() did not do.
[[nodiscard]] inline std::string warning_of_uncut(std::size_t left_whole) {
  return "the faces of " + std::to_string(left_whole) + (left_whole == 1 ? " object" : " objects") +
         " were not cut where others stand on them: too many objects or faces touch; patches that reach under others are less exact";
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/wall_cuts.cpp>
#endif
