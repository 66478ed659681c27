// SPDX-License-Identifier: MIT
#pragma once

// The kinds of changes that the intake makes to polygons, with counts and sentences.

#include <cstddef>
#include <cstdint>
#include <string>

namespace radiosity {

enum class ChangeKind : unsigned char {
  unusable,     // polygons with an unknown corner or material, or with a corner that is not finite: left out
  too_long,     // polygons with more than 20 000 corners: left out
  welded,       // vertices within the tolerance of another one: merged; size: the largest distance
  no_area,      // polygons without area: left out
  sliver,       // polygons narrower than the tolerance: left out; size: the largest width
  duplicate,    // polygons that coincide with another one, or with its back if that is not seen: left out
  unfolded,     // concave polygons that were divided as if they were convex (unfold.hpp): made whole
  not_planar,   // polygons divided into triangles; size: the largest distance of a corner from its plane
  crossing,     // polygons that cross themselves: divided into triangles
  touching,     // polygons that touch themselves, as on a bridge edge to a hole, or have very many corners: divided into triangles
  flattened,    // vertices moved into the planes of their polygons; size: the largest distance
  t_joint,      // vertices on the edge of another polygon: made corners of it; size: the largest distance from the edge
  nonmanifold,  // edges of more than two faces: cut
  turned,       // polygons whose orientation differs from that of their neighbours: turned over
  moebius,      // edges across which no consistent orientation is possible: cut
  to_light,     // polygons of solids that share walls, if light reaches only their backs: turned over
  loose,        // polygons that form no valid surface with their neighbours: surfaces of their own
  inside_out,   // closed shells facing inwards with nothing in them: turned over
  room,         // closed shells facing outwards around a lamp or an eye: turned over, as rooms
  lamp_laid,    // vertices of lamps beside a wall: moved onto it; size: the largest distance
  lamp_turned,  // lamps on a wall, or close in front of it, and facing it: turned over
  lamp_halved,  // lamps that emit on both sides, one of them close in front of a surface: this side is left out
  lamp_front,   // open lamps of which it is not known which side shines: their front shines
  decal_laid,   // vertices of flat surfaces beside a larger one: moved onto it; size: the largest distance
  overlapping,  // polygons of a surface that lie partly on larger ones in the same plane: made surfaces of their own
  dividing,     // polygons with light on both sides, such as walls between rooms: made to reflect on both
  both_sides,   // surfaces of mixed orientation: made to reflect on both sides
  open,         // open surfaces of which it is not known which side is seen: made to reflect on both sides
  from_behind,  // open surfaces whose backs are seen: made to reflect on both sides
  merged        // polygons that became part of a larger one; no size
};

struct Change {
  ChangeKind kind = ChangeKind::welded;
  std::size_t count = 0;
  double size = 0.0;        // the largest, a length; 0 for kinds without one
  std::uint32_t first = 0;  // the polygon of the input with the lowest number
  std::uint32_t worst = 0;  // the one with the largest size
};

// "412 polygons were not planar by up to 1.8 mm: split". Without the place, which only the caller knows. Lengths are in metres.
[[nodiscard]] std::string sentence(const Change& change);

// Does the sentence state the size? Not for sizes within rounding.
[[nodiscard]] bool tells_size(const Change& change);

// 0.0018 as "1.8 mm"
[[nodiscard]] std::string length_text(double metres);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/change.cpp>
#endif
