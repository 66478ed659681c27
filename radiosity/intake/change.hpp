// SPDX-License-Identifier: MIT
#pragma once

// What the intake changed in the polygons that it was given, and how often: a kind each, with its sentence.

#include <cstddef>
#include <cstdint>
#include <string>

namespace radiosity {

enum class ChangeKind : unsigned char {
  unusable,     // polygons whose corners or material do not exist, or with corners that are not finite: left out
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
  open,         // open surfaces of which nobody says which side is seen: made to reflect on both sides
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

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/change.cpp>
#endif
