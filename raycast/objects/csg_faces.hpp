// SPDX-License-Identifier: MIT
#pragma once

// Makes the faces of a CSG tree's boundary convex, and removes those that are thinner than the precision of the coordinates.

#include <string>

#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_tree.hpp>

namespace raycast::detail {

// Removes faces without area, which have no normal and no inside: each is joined with its neighbour at its longest edge. No surface moves
// by more than the thickness of the face.
void take_away_slivers(CsgBRep& brep);

// Divides all faces by diagonals until they are convex, or triangles where they are warped or thin (brep::split_nearly_simple). The
// sentence says why that was refused; it is empty as a rule.
[[nodiscard]] std::string cut_into_convex_parts(CsgBRep& brep, const CsgTree& tree);

// Where a solid touches itself, several edges may join the same two vertices, which a list of polygons cannot represent. All but one of
// them get a vertex in their middle.
void tell_edges_apart(CsgBRep& brep);

}  // namespace raycast::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_faces.cpp>
#endif
