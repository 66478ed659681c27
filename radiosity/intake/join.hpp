// SPDX-License-Identifier: MIT
#pragma once

// Groups that close a shell together: the walls of a room in one object of the file, its floor and its ceiling in others. Alone each is
// open, and nobody could tell its inside from its outside.
//
//      group "walls"     group "ceiling"        one shell
//      *---------*       *-----------*          *---------*
//      |         |                              |         |       each edge on the border of one
//      |         |   +                    ==>   |         |       lies on the border of another
//      |         |       *-----------*          |         |
//      *---------*       group "floor"          *---------*
//
// Borders match where their vertices are one (weld.hpp), or lie on an edge of the other within the same tolerance (t_joints.hpp). Only
// where every edge of some open parts matches one other are they joined, so that things which merely touch stay apart. Materials, names
// and objects stay those of the groups.

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Gives the faces of groups that close a shell together one number of a shell, and closes the T-joints between them.
void join_groups(Working& mesh);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/join.cpp>
#endif
