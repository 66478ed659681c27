// SPDX-License-Identifier: MIT
#pragma once

// Direct light of pixels through which an edge of a shadow runs.

#include <span>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// Light that changes by more than this share from one pixel to the next, or within one: an edge of a shadow, not only a slope.
inline constexpr double change_at_edge = 0.3;

// What to add to the direct light at `own` to make it that of its pixel: the mean over `few` other places of the pixel or, if these differ,
// for the lamps that make the difference the mean over `many`. All are places of the region; with few or many empty nothing is added.
[[nodiscard]] Color over_pixel(LitRegion& region, const FinalGather::Place& own, std::span<const FinalGather::Place> few,
                               std::span<const FinalGather::Place> many);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/shadow_edges.cpp>
#endif
