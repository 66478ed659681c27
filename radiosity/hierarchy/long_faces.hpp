// SPDX-License-Identifier: MIT
#pragma once

// Long faces are cut across before refinement begins. Regular refinement keeps the proportions of a face (paper 4.4): a wall of 1000 : 1
// gives patches of 1000 : 1 at every level. From the middle of such a patch all others beside it are near, compared with its length, so
// each must be linked with all of them, and the number of links grows like the length over the width. The paper's answer to bad proportions
// is a split object (2.2): a face is halved across its length until no part is longer than `longest_part` times its width, or until its
// parts are so small that refinement would hardly split them.
//
// The smallest part is half as large as that limit, so their number is bounded by the fineness of the run, however long a face is. Faces
// that share an edge are halved at the same places. Of curved objects only faces along straight lines are cut (the sides of cylinders and
// cones): no vertex is put beside the surface. Flat faces in convex parts (cut by diagonals) are left alone, so that they stay one root;
// what walls cut out of a face (wall_cuts.hpp) is a root of its own, and is cut. Invariant: the boundary stays valid, each part lies on the
// sheet of its face.

#include <vector>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// `min_area` is relative to the area of all faces. Time: linear in the number of faces and parts.
void cut_long_faces(std::vector<Surface>& surfaces, double min_area);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/long_faces.cpp>
#endif
