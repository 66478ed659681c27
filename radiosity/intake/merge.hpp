// SPDX-License-Identifier: MIT
#pragma once

// Coplanar neighbours of one material become one face: a wall of two triangles, or of two hundred, becomes one root of the hierarchy.
// Topology makes this easy, because each face knows its neighbours.
//
// A region of coplanar faces with a single simple outline becomes a face with that outline, convex or not. In a region with holes, faces
// are joined as long as the result is convex. Corners on a straight line that no other face needs are removed.

#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// The topology is invalid afterwards. Faces may be only nearly planar (clean.hpp); vertices are moved to make them planar, and if that
// fails the faces stay unchanged.
void merge_coplanar(Working& mesh, const Topology& topology);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/merge.cpp>
#endif
