// SPDX-License-Identifier: MIT
#pragma once

// Merges vertices within a tolerance of each other: a later vertex is replaced by the first kept one within the tolerance. So no vertex
// moves farther than that, and chains of near vertices do not collapse.

#include <span>

#include <radiosity/intake/polygons.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// Fills `out` with the remaining positions and the usable polygons of the input. The tolerance is relative to the bounds of the polygons
// that do not emit, if there are any, because a sun may be a thousand times as far away as all else.
void weld(const PolygonView& input, std::span<const Material> materials, double relative_tolerance, Working& out);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/weld.cpp>
#endif
