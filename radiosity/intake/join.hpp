// SPDX-License-Identifier: MIT
#pragma once

// Joins groups that together close a shell: a file may have the walls of a room in one object, its floor and its ceiling in others. Each
// of them alone is open, so its inside and outside could not be told apart.
//
//      group "walls"     group "ceiling"        one shell
//      *---------*       *-----------*          *---------*
//      |         |                              |         |       each edge on the border of one
//      |         |   +                    ==>   |         |       lies on the border of another
//      |         |       *-----------*          |         |
//      *---------*       group "floor"          *---------*
//
// Borders match if their vertices are the same (weld.hpp), or lie on an edge of the other one within the same tolerance (t_joints.hpp).
// Open parts are joined only if each of their border edges matches exactly one other, so that objects which merely touch stay separate.
// Materials, names and objects remain those of the groups.

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Gives the faces of groups that together close a shell a common shell number, and closes the T-joints between them.
void join_groups(Working& mesh);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/join.cpp>
#endif
