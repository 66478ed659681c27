// SPDX-License-Identifier: MIT
#pragma once

// Constructive solid geometry, exact (paper 2.2 and 5): all of brep/csg in one.
//
//   Grid grid(lo, hi);                              one for all leaves of a tree, around all of them
//   auto a = make_solid(brep, grid);                a leaf, or a refusal that names faces
//   auto c = unite(*a, *b);                         also intersect, subtract, imprint
//   auto mesh = to_brep<Mesh>(*c);                  a valid BRep with positions in double
//
// Leaves are snapped to the grid once; from then on nothing is rounded, at any depth.

#include <brep/csg/booleans.hpp>
#include <brep/csg/check_export.hpp>
#include <brep/csg/imprint.hpp>
#include <brep/csg/make_solid.hpp>
#include <brep/csg/slits.hpp>
#include <brep/csg/to_brep.hpp>
