// SPDX-License-Identifier: MIT
#pragma once

// Measures how the direct light varies across a patch, and finds the cut that removes most of this variance.
//
// A leaf has one radiosity, so the variance of the light over it is the part that it cannot represent. It is measured at 36 points, with
// shadows and penumbrae (LitRegion). A cut leaves two parts, each with a mean of its own, and so removes the variance between the two
// means. Two kinds of cuts are compared: along a critical line that crosses the patch, and halving cuts through its centroid, parallel to
// one of its sides. As a result a penumbra is divided into strips along its edge, each with nearly constant light.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// Limit of the length of a part relative to its width; larger if the patch itself is longer.
inline constexpr double longest_cut_part = 8.0;

// A cut along the plane through a point; the normal of the cut lies in the plane of the patch.
struct CutPlane {
  glm::dvec3 point{0.0}, normal{0.0};
};

// A lamp that may be hidden from some of the patch, and the share of its light that arrives there.
struct LampSeen {
  std::uint32_t surface = 0;  // the lamp's input surface
  double share = 0.0;
};

struct DirectVariation {
  double square = 0.0;             // mean square of the reflected direct light, summed over the channels; (W/m2)^2
  double variance = 0.0;           // variance of that light, likewise
  std::optional<CutPlane> halves;  // nothing: every halving cut leaves parts that are too long
  std::optional<CutPlane> along;   // along a critical line, if that removes at least half as much variance as `halves`
  std::vector<LampSeen> seen;
};

// For a flat patch with area; `region` must be made for its points.
[[nodiscard]] DirectVariation direct_variation(LitRegion& region, const Patch& patch, const Color& reflectance,
                                               const std::vector<CriticalLine>& lines);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/discontinuity/direct_variation.cpp>
#endif
