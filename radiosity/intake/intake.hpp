// SPDX-License-Identifier: MIT
#pragma once

// Polygons from anywhere become objects that can be solved. What other programs write is rarely a sound boundary: corners that lie in one
// place are several vertices, quadrilaterals are not planar, faces are doubled or have no area, three walls meet in an edge, half of the
// faces look the other way. Nothing of this is refused: it is repaired or left out, and every change is counted, with its size and with
// the first polygon that it concerned.
//
// The steps, each in a file of its own:
//     weld       vertices within `weld` of each other become one                              weld.hpp
//     backs      two faces at one place that look opposite ways become one with two sides      backs.hpp
//     clean      repeated corners, faces without area, slivers, duplicates; what is not        clean.hpp
//                planar or crosses itself is cut along the best diagonals
//     t_joints   a vertex on the edge of another face becomes a corner of that face            t_joints.hpp
//     join       groups whose borders match, and which close a shell together, are one shell   join.hpp
//     facing     pieces of solids that are each other's walls look to the light, what divides    facing.hpp, side_light.hpp
//                two rooms looks to both
//     topology   faces are turned alike; where that cannot be, or more than two faces meet,    topology.hpp
//                the surface is cut
//     merge      coplanar neighbours of one material become one face (fewer input faces)       merge.hpp
//     lamps      what lies flush in a wall shines away from it                                 lamps.hpp
//     objects    closed shells become solids or rooms, all else surfaces with one or two       objects.hpp, shells.hpp,
//                sides                                                                         open_surfaces.hpp
//
// Time: n log n for n polygons of bounded size. Nothing is kept of the input.

#include <cstddef>
#include <span>
#include <vector>

#include <radiosity/intake/change.hpp>
#include <radiosity/intake/polygons.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

struct Intake {
  std::vector<SceneObject> objects;  // empty when nothing had an area
  std::vector<Room> rooms;
  PolygonParts parts;
  std::vector<Change> changes;  // in the order of ChangeKind, those that occurred
  std::size_t polygons = 0;     // of the input
  std::size_t faces = 0;        // of the objects; two for a polygon with two sides
};

// `materials` are those of the scene, which must be sound. A polygon whose material does not exist is unusable.
[[nodiscard]] Intake take_in(const PolygonView& input, std::span<const Material> materials, const IntakeOptions& options = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/intake.cpp>
#endif
