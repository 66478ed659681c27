// SPDX-License-Identifier: MIT
#pragma once

// Direct light of pixels that the edge of a shadow crosses.

#include <optional>
#include <span>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// A relative change of light from one pixel to the next, or within a pixel, that counts as the edge of a shadow rather than a slope.
inline constexpr double change_at_edge = 0.3;

// The direct light, averaged over the pixel of `own`: the mean over the places `few` of the pixel. If these and `own` differ, the lamps
// that cause the difference are averaged over `many` instead. All places belong to the region. Nothing if few or many is empty.
[[nodiscard]] std::optional<Color> over_pixel(LitRegion& region, const FinalGather::Place& own, std::span<const FinalGather::Place> few,
                                              std::span<const FinalGather::Place> many);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/shadow_edges.cpp>
#endif
