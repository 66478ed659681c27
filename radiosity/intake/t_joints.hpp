// SPDX-License-Identifier: MIT
#pragma once

// Closes T-joints: if a vertex lies on the edge of another face, it becomes a corner of that face.
//
//      *-------*             *-------*
//      |       |\            |       |\         the face on the left has four corners before
//      |       | *   ==>     |       * *        and five after: both sides now meet in the same edges
//      |       |/            |       |/
//      *-------*             *-------*
//
// Only vertices of edges with a single face are examined, separately for each shell (working.hpp).

#include <cstdint>

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// For shells with at least this number.
void close_t_joints(Working& mesh, std::uint32_t first_shell = 0);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/t_joints.cpp>
#endif
