// SPDX-License-Identifier: MIT
#pragma once

// Polygons that were given whole and again in parts, as modelling programs leave them behind when a face is divided. Their borders would
// have three faces at an edge, which would cut up the surface.
//
//      *-------*         *---*---*          *---*---*
//      |       |         |   |   |          |   |   |
//      |       |    +    |   *---*   ==>    |   *---*     twice; then drop_duplicates() and join_backs()
//      |       |         |   |   |          |   |   |     treat each part like any polygon that was given twice
//      *-------*         *---*---*          *---*---*

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Cuts each face into the parts that other faces of its shell divide it into, up to a thousand, if these cover it exactly once. It keeps
// its orientation and material. So of different materials that of the later polygon is seen, whole or in parts (drop_duplicates).
void match_tilings(Working& mesh);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/tilings.cpp>
#endif
