// SPDX-License-Identifier: MIT
#pragma once

// Lamps that lie flush in a wall or a ceiling: a quadrilateral in the plane of a larger one. Programs in which both sides of a lamp shine
// write them either way up, and rounding puts them before or behind the surface; a solver would lose all of their light in the wall. So
// such a lamp is laid into the plane, and where it shows its front to the back of the surface that it lies on, it is turned (shells.hpp,
// objects.hpp).

#include <cstdint>
#include <span>
#include <vector>

#include <radiosity/intake/shells.hpp>
#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// A face of an open lamp and a face of something else on which its middle lies.
struct FlushFace {
  std::uint32_t lamp = 0, under = 0;
  bool opposite = false;                                                // they look opposite ways
  enum class Gap : unsigned char { no, before, behind } gap = Gap::no;  // they lie apart: the face is close before the lamp, behind it
};

// Finds all of them, where the lamp lies on the other face within four tolerances of welding, which is as far as the rounding of six digits
// may take a corner and a plane apart, or within a thousandth of its own size behind it or with its front to it. Moves the vertices of the
// lamp, as far as no other surface has them, into the plane of the nearest. A lamp that lies on nothing, but has a parallel face before or
// behind it that is at most a fiftieth of its size away, with the other way free for ten times as far, and something to light
// beyond, is found with that face.
[[nodiscard]] std::vector<FlushFace> lay_lamps(Working& mesh, const Topology& topology, std::span<const Material> materials);

// Lamps more than half of which lies on something shine away from it, on that side alone. Where they lie between two sides, as of a wall
// without thickness, they stay as they are. A panel under a ceiling was not meant to light the gap: where one side looks at the front of
// something close before it, lamps of one side shine the other way, and of lamps of two sides the other one is left. From a gap of a
// fiftieth of a lamp's size some percent of the light would get out, and no mesh is fine enough to tell how much. `backs`: of each face,
// whether its back is seen where it is a surface. The roles of the shells are known.
void turn_lamps(Working& mesh, const Topology& topology, std::span<const Material> materials, std::span<const FlushFace> flush,
                const std::vector<bool>& backs, Shells& shells);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/lamps.cpp>
#endif
