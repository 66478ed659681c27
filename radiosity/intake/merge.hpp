// SPDX-License-Identifier: MIT
#pragma once

// Coplanar neighbours of one material become one face: a wall of two triangles, or of two hundred, is one root of the hierarchy. The
// topology makes that easy, because each face knows its neighbours.
//
// A region of coplanar faces with one simple outline becomes that outline, convex or not. Where it has holes its faces are joined as long
// as they stay convex. Corners on a straight line that no other face needs are taken away.

#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Afterwards the topology no longer fits. Faces may be nearly planar only (clean.hpp); vertices are moved to make them planar, and where
// that does not succeed the faces stay as they were.
void merge_coplanar(Working& mesh, const Topology& topology);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/merge.cpp>
#endif
