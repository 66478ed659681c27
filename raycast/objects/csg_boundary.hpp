// SPDX-License-Identifier: MIT
#pragma once

// The boundary of a CSG tree as polygons: every leaf is approximated, brep/csg cuts and glues the approximations exactly, faces that are
// not convex (a wall with windows) are cut by diagonals, and the vertices are put back from the grid onto the true sheets.
//
// Each face carries the sheet that it lies on, numbered as the tree numbers them. How vertices are put back: csg_place.hpp.

#include <optional>
#include <string>

#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_region.hpp>
#include <raycast/objects/csg_tree.hpp>

namespace raycast {

struct CsgBoundary {
  CsgBRep brep;       // without faces when nothing is left
  double off = 0.0;   // how far its vertices are off the sheets of their faces, at most
  double near = 0.0;  // four cells of the coarsest grid: what is closer may have become one
  double chord = 0.0;
};
struct CsgBoundaryResult {
  std::optional<CsgBoundary> boundary;
  std::string refusal;
  bool too_many_faces = false;  // why it was refused
};

// The boundary of the tree with chords within `tolerance` of curved sheets, and finer where small parts meet (csg_plan.hpp); no faces when
// nothing is left. `region`: csg_region(tree). Refused, with a sentence: what
// make_solid of brep/csg refuses in a leaf (it crosses itself once it is snapped to the grid), faces too thin for the grid.
[[nodiscard]] CsgBoundaryResult csg_boundary(const CsgTree& tree, const CsgRegion& region, double tolerance);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_boundary.cpp>
#endif
