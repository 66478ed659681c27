// SPDX-License-Identifier: MIT
#pragma once

// Direct light of pixels through which an edge of a shadow runs.

#include <optional>
#include <span>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// Light that changes by more than this share from one pixel to the next, or within one: an edge of a shadow, not only a slope.
inline constexpr double change_at_edge = 0.3;

// The direct light on the pixel of `own`: the mean over `few` other places of the pixel or, if these and `own` differ, for the lamps that
// make the difference the mean over `many`. All are places of the region; nothing when few or many are empty.
[[nodiscard]] std::optional<Color> over_pixel(LitRegion& region, const FinalGather::Place& own, std::span<const FinalGather::Place> few,
                                              std::span<const FinalGather::Place> many);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/shadow_edges.cpp>
#endif
