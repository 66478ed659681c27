// SPDX-License-Identifier: MIT
#pragma once

// The boundary of a CSG tree as polygons. Every leaf is approximated; brep/csg intersects and joins the approximations exactly; faces
// that are not convex (a wall with windows) are divided by diagonals; vertices are moved from the grid back onto the true sheets.
//
// Each face has the number of the sheet on which it lies, as in the tree. csg_place.hpp says how vertices are moved back.

#include <optional>
#include <string>

#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_region.hpp>
#include <raycast/objects/csg_tree.hpp>

namespace raycast {

struct CsgBoundary {
  CsgBRep brep;       // has no faces if nothing is left
  double off = 0.0;   // largest distance of a vertex from the sheets of its faces
  double near = 0.0;  // four cells of the coarsest grid: closer points may have been merged
  double chord = 0.0;
};
struct CsgBoundaryResult {
  std::optional<CsgBoundary> boundary;
  std::string refusal;
  bool too_many_faces = false;  // the reason for the refusal
};

// Returns the boundary of the tree with chords within `tolerance` of curved sheets, and finer where small parts meet (csg_plan.hpp);
// without faces if nothing is left. `region`: csg_region(tree). Refuses, with a sentence: a leaf that make_solid of brep/csg refuses (it
// intersects itself after snapping to the grid), and faces too thin for the grid.
[[nodiscard]] CsgBoundaryResult csg_boundary(const CsgTree& tree, const CsgRegion& region, double tolerance);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_boundary.cpp>
#endif
