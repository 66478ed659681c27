// SPDX-License-Identifier: MIT
#pragma once

// Cuts long faces across before refinement begins. Regular refinement keeps the proportions of a face (paper 4.4): a wall of 1000 : 1
// gives patches of 1000 : 1 at every level. All other patches beside such a patch are near compared with its length, so it must be linked
// with all of them, and the number of links grows with the ratio of length to width. The paper's remedy for bad proportions is a split
// object (2.2): a face is halved across its length until no part is longer than `longest_part` times its width, or until its parts are so
// small that refinement would hardly split them.
//
// The smallest part has half of that limit's area, so the number of parts is bounded by the fineness of the run, however long a face is.
// Faces that share an edge are halved at the same places. On curved objects only faces with straight long sides are cut (the sides of
// cylinders and cones), because a new vertex must lie on the surface. Flat faces in convex parts (cut by diagonals) are not cut, so that
// they stay one root; parts made by walls (wall_cuts.hpp) are roots of their own and are cut. Invariant: the boundary stays valid, and
// each part lies on the sheet of its face.

#include <vector>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// `min_area`: relative to the area of all faces. Time: linear in the number of faces and parts.
void cut_long_faces(std::vector<Surface>& surfaces, double min_area);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/long_faces.cpp>
#endif
