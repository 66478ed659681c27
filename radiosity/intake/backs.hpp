// SPDX-License-Identifier: MIT
#pragma once

// Polygons that were given twice, once for each side: the same corners in opposite order. Programs without two-sided materials write such
// files. As separate faces they would cut up the surface, because its edges would have three or four faces. So one face represents both
// and stores the material of its back. If the surface turns out to enclose something, only one side is seen; otherwise both are
// (objects.hpp).

#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// If two triangles form a quadrilateral that was given again for its back, but cut along the other diagonal, the first two are re-cut
// along that diagonal. Programs that triangulate polygons from their first corner produce this. A quadrilateral without neighbours must
// be nearly planar (clean.hpp), because otherwise its four triangles are a tetrahedron.
void match_diagonals(Working& mesh);

// Of two faces of one shell with the same corners in opposite order, removes the later one and stores it as the back of the earlier one.
// Not where solids touch in that face, which would leave an edge with more than two faces.
void join_backs(Working& mesh);

// In a closed shell of which only some faces have backs, the backs are removed, because it is seen from one side only.
void settle_backs(Working& mesh, const Topology& topology);

// Counts the polygons given for the back of this face as duplicates.
void leave_out_backs(Working& mesh, const Face& face);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/backs.cpp>
#endif
