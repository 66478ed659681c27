// SPDX-License-Identifier: MIT
#pragma once

// Turns polygons from any source into objects that can be solved. Models of other programs rarely form a valid boundary: one corner is
// several vertices, quadrilaterals are not planar, faces are duplicated or have no area, three walls meet in an edge, half of the faces
// have the opposite orientation. None of this is refused: it is repaired or left out, and every kind of change is counted, with its
// largest size and the first polygon concerned.
//
// The steps, each in a file of its own:
//     weld       vertices within `weld` of each other become one                              weld.hpp
//     backs      two coincident faces of opposite orientation become one with two sides        backs.hpp
//     unfold     concave polygons that were divided as if they were convex are made whole      unfold.hpp
//     clean      removes repeated corners, faces without area, slivers and duplicates; cuts    clean.hpp
//                faces that are not planar or cross themselves along the best diagonals
//     t_joints   a vertex on the edge of another face becomes a corner of that face            t_joints.hpp
//     join       groups with matching borders that together close a shell become one shell     join.hpp
//     facing     pieces of solids that share walls are turned to the light; pieces that        facing.hpp, side_light.hpp
//                divide two rooms become visible from both
//     topology   gives faces a consistent orientation; where that is impossible, or more       topology.hpp
//                than two faces meet, the surface is cut
//     merge      coplanar neighbours of one material become one face (fewer input faces)       merge.hpp
//     lamps      lamps that lie flush in a wall shine away from it                             lamps.hpp
//     decals     flat surfaces that lie on a larger one cover it                               decals.hpp
//     layers     of polygons of one surface that lie partly on each other the smaller is seen  layers.hpp
//     objects    closed shells become solids or rooms, all else surfaces with one or two       objects.hpp, shells.hpp,
//                sides                                                                         open_surfaces.hpp, subset.hpp
//
// Time: n log n for n polygons of bounded size. Keeps no reference to the input.

#include <cstddef>
#include <span>
#include <vector>

#include <radiosity/intake/change.hpp>
#include <radiosity/intake/polygons.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

struct Intake {
  std::vector<SceneObject> objects;  // empty if no polygon has an area
  std::vector<Room> rooms;
  PolygonParts parts;
  std::vector<Change> changes;  // those that occurred, in the order of ChangeKind
  std::size_t polygons = 0;     // of the input
  std::size_t faces = 0;        // of the objects; two for a polygon with two sides
};

// `materials`: those of the scene, which must be valid. A polygon whose material does not exist counts as unusable.
[[nodiscard]] Intake take_in(const PolygonView& input, std::span<const Material> materials, const IntakeOptions& options = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/intake.cpp>
#endif
