// SPDX-License-Identifier: MIT
#pragma once

// Makes the faces of a CSG tree's boundary convex, and takes away those that are thinner than the coordinates are exact.

#include <string>

#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_tree.hpp>

namespace raycast::detail {

// A face without area has no normal and no inside. It goes into the neighbour at its longest edge; nothing moves by more than it is thin.
void take_away_slivers(CsgBRep& brep);

// Cuts all faces by diagonals until they are convex. `planar`: refused, with a sentence, is a face that is not simple. Else faces need not
// be quite planar: where no diagonal is found they fall into triangles.
[[nodiscard]] std::string cut_into_convex_parts(CsgBRep& brep, const CsgTree& tree, bool planar);

// Where a solid touches itself, several edges may join the same two vertices, which no list of polygons can say. All but one get a vertex
// in their middle.
void tell_edges_apart(CsgBRep& brep);

}  // namespace raycast::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_faces.cpp>
#endif
