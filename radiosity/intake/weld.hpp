// SPDX-License-Identifier: MIT
#pragma once

// Vertices that lie within a tolerance of each other become one: the first of them. A later vertex joins the first kept one within the
// tolerance, so no vertex moves farther than that, and chains of near vertices do not collapse.

#include <cstddef>

#include <radiosity/intake/polygons.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Fills `out` with the positions that remain and with the polygons of the input; those that cannot be used are left out.
void weld(const PolygonView& input, std::size_t materials, double relative_tolerance, Working& out);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/weld.cpp>
#endif
