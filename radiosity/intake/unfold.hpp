// SPDX-License-Identifier: MIT
#pragma once

// Concave polygons that another program divided into triangles as if they were convex: from one corner, its apex, to each side. Where the
// outline turns back as seen from there, triangles lie folded on others, and beyond the outline.
//
//         d--c        With the apex a, the triangles are a b c, a c d, a d e and a e f. From d to e the outline turns back: a d e has
//         |  |        the opposite orientation and lies partly on a c d; both reach beyond the outline. With its sign, the area of
//         |  |        a d e is subtracted from that of the others, so that they sum up to that of the polygon. Sides that two of the
//      f--e  |        triangles share cancel: what is left is the outline.
//      |     |
//      a-----b

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Makes such triangles one face. Triangles are taken for a fan if they have a corner in common, are connected across the sides at it, lie
// in one plane, belong to one group and have one material, at least two of them lie folded on each other, their outline is a simple
// polygon, and no other triangle lies folded on them. (A flap folded flat onto its sheet cannot be told from them.) At most 1000 triangles.
// Must see triangles without area, too, because a fan may have some.
void unfold_fans(Working& mesh);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/unfold.cpp>
#endif
