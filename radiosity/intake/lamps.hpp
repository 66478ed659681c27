// SPDX-License-Identifier: MIT
#pragma once

// Lamps that lie flush in a wall or a ceiling: a quadrilateral in the plane of a larger one. Programs in which both sides of a lamp emit
// write them with either orientation, and rounding puts them in front of or behind the surface; without correction all of their light
// would be lost in the wall. So such a lamp is moved into the plane, and if its front faces the back of the surface on which it lies, it
// is turned (shells.hpp, objects.hpp).

#include <cstdint>
#include <span>
#include <vector>

#include <radiosity/intake/shells.hpp>
#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// A face of an open lamp, and another face on which its centre lies.
struct FlushFace {
  std::uint32_t lamp = 0, under = 0;
  bool opposite = false;  // do they have opposite orientations?
  // If not in contact: is the other face close in front of the lamp, or close behind it?
  enum class Gap : unsigned char { no, before, behind } gap = Gap::no;
  double distance = 0.0;  // of the gap, relative to the size of the lamp
};

// Finds all such pairs. A lamp lies on another face if it is within four tolerances of welding (the largest gap that the rounding of six
// digits can cause between a corner and a plane), or within a thousandth of its own size behind the face or with its front to it. Moves
// the vertices of the lamp, unless they belong to another surface, too, into the plane of the nearest face. A lamp that lies on nothing
// is also paired with a parallel face in front of it or behind it at a distance of at most a tenth of its size, if the other direction is
// free for ten times that distance and contains something to light.
[[nodiscard]] std::vector<FlushFace> lay_lamps(Working& mesh, const Topology& topology, std::span<const Material> materials);

// A lamp of which more than half lies on other faces emits only on the side away from them. Lamps that lie between two visible sides, as
// of a wall without thickness, stay unchanged. If one side of a lamp faces the front of something close to it, as a panel under a
// ceiling, it was not meant to light the gap: a one-sided lamp is turned, and a two-sided lamp keeps only its other side. From a gap of a
// fiftieth of the lamp's size only some percent of the light would escape, and no mesh is fine enough to compute how much. A one-sided lamp
// whose side is no more than a guess (`sides_unknown`), by the order of its corners, is turned from a gap of up to a tenth of its size.
// `backs`: by face, is its back visible if it becomes a surface? The roles of the shells must be known.
void turn_lamps(Working& mesh, const Topology& topology, std::span<const Material> materials, std::span<const FlushFace> flush,
                const std::vector<bool>& backs, bool sides_unknown, Shells& shells);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/lamps.cpp>
#endif
