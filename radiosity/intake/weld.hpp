// SPDX-License-Identifier: MIT
#pragma once

// Vertices that lie within a tolerance of each other become one: the first of them. A later vertex joins the first kept one within the
// tolerance, so no vertex moves farther than that, and chains of near vertices do not collapse.

#include <span>

#include <radiosity/intake/polygons.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// Fills `out` with the positions that remain and with the polygons of the input; those that cannot be used are left out. The tolerance is
// relative to the bounds of what does not shine, where there is such: a sun may be a thousand times as far as all else.
void weld(const PolygonView& input, std::span<const Material> materials, double relative_tolerance, Working& out);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/weld.cpp>
#endif
