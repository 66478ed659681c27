// SPDX-License-Identifier: MIT
#pragma once

// Polygons that were given twice, once for each side: the same corners, in opposite order. Programs write them that know no material with
// two sides. As faces of their own they would cut the surface, for an edge of it would have three or four faces. So one stands for both and
// knows the material of its back. Where the surface turns out to enclose something, one side is seen; elsewhere both are (objects.hpp).

#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Two triangles whose quadrilateral was given again for its back, but cut along the other diagonal, are cut along that one, too. Programs
// that cut polygons into triangles from their first corner on write both sides so. A quadrilateral that has no neighbours must be nearly
// planar (clean.hpp): otherwise its four triangles are a tetrahedron.
void match_diagonals(Working& mesh);

// Of two faces of one shell with the same corners in opposite order, the later is left out and the earlier gets it as its back; but not
// where solids touch in that face, so that an edge of it would keep more than two.
void join_backs(Working& mesh);

// A closed shell of which only some faces have backs looks one way: the backs are left out.
void settle_backs(Working& mesh, const Topology& topology);

// Counts the polygons that were given for the back of the face as duplicates, which are left out.
void leave_out_backs(Working& mesh, const Face& face);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/backs.cpp>
#endif
