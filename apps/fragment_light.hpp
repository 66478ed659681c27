// SPDX-License-Identifier: MIT
#pragma once

// Direct light in the pixels of a block that see one surface (gather_picture.hpp). Where the surface fills the block, most pixels take
// their share of a lamp from their neighbours: all, where those see the whole lamp or nothing of it; else where they agree. The shadow of a
// thin thing can pass between them if the lamp is narrow, for then it is as thin; so a narrow lamp is looked for from all pixels at the
// border of the block, which a shadow of some length crosses, and if those differ, from every pixel.

#include <cstdint>
#include <span>
#include <vector>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

#include "apps/fragments.hpp"

namespace apps {

constexpr std::uint32_t block_side = 8;  // pixels

// Adds to the irradiance of the fragments `own`, all of one block and one surface, what comes from the lamps.
void add_direct_light(const radiosity::FinalGather& light, std::span<const std::uint32_t> own, const std::vector<Fragment>& fragments,
                      std::vector<radiosity::Color>& irradiance);

}  // namespace apps
