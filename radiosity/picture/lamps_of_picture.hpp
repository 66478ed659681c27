// SPDX-License-Identifier: MIT
#pragma once

// Which surfaces may be lamps of a picture, whose direct light is found for each pixel. Where more shine than there can be lamps, bodies
// that are little brighter than the mean (lamp_choice.hpp) are left to the rays of the indirect light: large ones, because rays meet them,
// and those of very many faces, because summing these up for each pixel takes too long. A small bulb stays a lamp.

#include <vector>

#include <radiosity/picture/lookup.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// By input surface: its emission, or 0 if it is no lamp. `emission`: that of all.
[[nodiscard]] std::vector<Color> emission_of_lamps(const Lookup& lookup, const std::vector<Color>& emission);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/lamps_of_picture.cpp>
#endif
