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
// Only the vertices of edges with a face on one side are looked at, each shell by itself (working.hpp).

#include <cstdint>

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Of the shells from this one on.
void close_t_joints(Working& mesh, std::uint32_t first_shell = 0);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/t_joints.cpp>
#endif
