// SPDX-License-Identifier: MIT
#pragma once

// Direct light of fragments that the edge of a shadow crosses (smooth_shadows.hpp finds them).

#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// A relative change of light from one pixel to the next, or within a pixel, that counts as the edge of a shadow. With .3, shadows of thin
// things that leave more light than that were missed.
inline constexpr double change_at_edge = 0.2;

// A place of a fragment, and where the ray to it crosses the pixel, whose sides are 1.
struct PixelPlace {
  FinalGather::Place place;
  glm::dvec2 at{0.0};
};

// Direct light, averaged over places of one fragment.
struct MeanLight {
  Color direct{0.0};
  bool mixed = false;         // the light of the places changes as at an edge, not as on a slope
  std::vector<double> light;  // of each place, the sum of its channels; not known of `many` places unless it is mixed
};

// The mean over all these places of the region, of which there must be one at least. `others`: the light that each receives from
// elsewhere.
[[nodiscard]] MeanLight mean_light(LitRegion& region, std::span<const PixelPlace> places, const Color& others);

// The mean over `few` places, the middle of the pixel and SeenSurfaces::four. If the light at these is mixed, the lamps that cause the
// difference are averaged over `many` instead.
[[nodiscard]] MeanLight mean_light(LitRegion& region, std::span<const PixelPlace> few, std::span<const PixelPlace> many,
                                   const Color& others);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/shadow_edges.cpp>
#endif
