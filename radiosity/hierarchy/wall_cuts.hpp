// SPDX-License-Identifier: MIT
#pragma once

// Cuts faces where walls stand on them. A patch has one radiosity, so a patch that extends under a wall from one room into the next
// receives light on one side and sends it on the other: light leaks through the wall, the more the larger the patch. If flat faces of
// other objects, or of the same open surface, meet a face along about half of a line across it, the face is cut along that line before
// refinement begins (paper 2.2: a split object finds the place, split_plane.hpp). Then no patch spans the wall, and the area under it is
// a patch of its own, which is buried. For thin walls that stand on a face along two to twelve lines, 7 % of a line is enough, because
// the area between them, for instance under a tent on a wide ground, may be dark.
//
// In the same way a face is cut along the outline of an object parallel to it and close in front of it, such as a lamp under a ceiling or
// a shelf in front of a wall: a patch that extends beyond the outline would receive light outside it and send a part of that light to the
// back of the lamp.
//
// Walls that are frames around lamps cut a face even if they are many and short (lamp_frames.hpp).
//
// Other short walls do not divide a face; refinement resolves the shadow at their feet. Invariant: the boundary stays valid, and each part
// lies on the sheet of its face.

#include <cstddef>
#include <string>
#include <vector>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

inline constexpr std::size_t most_wall_pairs = 30'000'000;

// Cuts the faces of flat objects; to be called before any refinement. Not cut are objects with more than ten million pairs of faces to
// examine, and objects covered by a duplicate. Time: pairs of objects whose bounds are close to each other, of which at most `most_pairs`
// are examined, and pairs of their faces. `emission`: of each input surface, in which frames around lamps are found; without it, none.
// Returns the number of objects that were left whole because of either limit.
std::size_t cut_at_walls(std::vector<Surface>& surfaces, double diameter, std::size_t most_pairs = most_wall_pairs,
                         const std::vector<Color>& emission = {});

// The warning about objects that cut_at_walls() left whole.
[[nodiscard]] inline std::string warning_of_uncut(std::size_t left_whole) {
  return "the faces of " + std::to_string(left_whole) + (left_whole == 1 ? " object" : " objects") +
         " were not cut where others stand on them: too many objects or faces touch; patches that reach under others are less exact";
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/wall_cuts.cpp>
#endif
