// SPDX-License-Identifier: MIT
#pragma once

// T-joints: where a vertex lies on the edge of another face, that face gets it as a corner.
//
//      *-------*             *-------*
//      |       |\            |       |\         the face on the left has four corners before
//      |       | *   ==>     |       * *        and five after: both sides now meet in the same edges
//      |       |/            |       |/
//      *-------*             *-------*
//
// Only the vertices of edges with a face on one side are looked at, each group by itself.

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

void close_t_joints(Working& mesh);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/t_joints.cpp>
#endif
