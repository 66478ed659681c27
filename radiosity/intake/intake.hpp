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
//     objects    closed shells become solids or rooms, all else surfaces with one or two       objects.hpp
//                sides
//
// Time: n log n for n polygons of bounded size. Nothing is kept of the input.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>

#include <radiosity/scene/scene.hpp>

namespace radiosity {

// The input, which the caller keeps: polygon p has the corners first_corner[p] to first_corner[p + 1] - 1, each an index into positions,
// counter-clockwise seen from the front.
struct PolygonView {
  std::span<const glm::dvec3> positions;
  std::span<const std::uint32_t> corners;
  std::span<const std::uint32_t> first_corner;   // one more than there are polygons
  std::span<const std::uint32_t> material;       // of each polygon: an index into the scene's materials
  std::span<const std::uint32_t> group = {};     // of each polygon: an index into names; empty: all are in one
  std::span<const std::string> names = {};       // of the groups
  std::span<const std::uint8_t> two_sided = {};  // of each material: do its surfaces reflect on both sides? Empty: none does

  [[nodiscard]] std::size_t count() const { return first_corner.empty() ? 0 : first_corner.size() - 1; }
};

struct IntakeOptions {
  // Vertices closer than this are one, and a vertex so close to an edge lies on it; relative to the diagonal of the bounds of all.
  double weld = 1e-6;
  bool merge = true;       // coplanar neighbours of one material
  bool two_sided = false;  // all surfaces that enclose nothing
  // Points that must be seen, such as the eyes of cameras: a closed shell around one of them, or around a lamp, is a room.
  std::vector<glm::dvec3> eyes = {};
};

enum class ChangeKind : unsigned char {
  unusable,     // polygons whose corners do not exist or are not finite: left out
  too_long,     // polygons with more than 20 000 corners: left out
  welded,       // vertices that lay within the tolerance of another one: made one; size: the largest distance
  no_area,      // polygons without area: left out
  sliver,       // polygons narrower than the tolerance: left out; size: the largest width
  duplicate,    // polygons that lay on another one, or on its back where that is not seen: left out
  not_planar,   // polygons cut into triangles; size: the largest distance of a corner from its plane
  crossing,     // polygons that crossed themselves: cut into triangles
  touching,     // polygons that touched themselves, as on a bridge edge to a hole, or had very many corners: cut into triangles
  flattened,    // vertices that were moved into the planes of their polygons; size: the largest distance
  t_joint,      // vertices on the edge of another polygon: made corners of it; size: the largest distance from the edge
  nonmanifold,  // edges of more than two faces: cut
  turned,       // polygons that looked another way than their neighbours: turned
  moebius,      // edges across which faces cannot be turned alike: cut
  to_light,     // polygons of solids that are one another's walls, whose backs alone the light reaches: turned
  loose,        // polygons that fit to none of their neighbours: surfaces of their own
  inside_out,   // closed shells with nothing in them that looked inwards: turned
  room,         // closed shells around a lamp or an eye that looked outwards: turned, as rooms
  lamp_laid,    // vertices of lamps that lay beside a wall: moved onto it; size: the largest distance
  lamp_turned,  // lamps that lay on a wall, or close before it, and looked into it: turned
  lamp_halved,  // lamps of which both sides shine, one of them close before a surface: the other one alone
  dividing,     // polygons with light on both sides, as walls between rooms: made to reflect on both
  both_sides,   // surfaces of mixed orientation: made to reflect on both sides
  merged        // polygons that became part of a larger one; size: none
};

struct Change {
  ChangeKind kind = ChangeKind::welded;
  std::size_t count = 0;
  double size = 0.0;        // the largest, a length; 0 where the kind has none
  std::uint32_t first = 0;  // the polygon of the input with the lowest number
  std::uint32_t worst = 0;  // the one with the largest size
};

// "412 polygons were not planar by up to 1.8 mm: split". Without the place, which only the caller can name. Lengths are taken as metres.
[[nodiscard]] std::string sentence(const Change& change);

// Does the sentence tell the size? What lies where it should up to rounding has none to tell.
[[nodiscard]] bool tells_size(const Change& change);

// 0.0018 as "1.8 mm"
[[nodiscard]] std::string length_text(double metres);

// Where a polygon of the input went: it lies on this sheet of an object, alone, together with others, or with a part of it.
struct PolygonPart {
  std::uint32_t object = 0, sheet = 0;
  bool back = false;  // the sheet shows the side from which the polygon's corners run clockwise
};

// Of every polygon its parts. One that was left out has none; one with two sides has them on either.
struct PolygonParts {
  std::vector<std::uint32_t> first{0};  // of polygon p: first[p] to first[p + 1] - 1
  std::vector<PolygonPart> all;

  [[nodiscard]] std::span<const PolygonPart> of(std::size_t polygon) const {
    return std::span(all).subspan(first[polygon], first[polygon + 1] - first[polygon]);
  }
};

// A closed shell that is seen from inside, whatever became of it: an object, a cavity of one, or surfaces of several groups.
struct Room {
  raycast::Box bounds;
  bool within_walls = false;  // a closed shell that is seen from outside surrounds it
};

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
