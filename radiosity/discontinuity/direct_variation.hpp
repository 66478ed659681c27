// SPDX-License-Identifier: MIT
#pragma once

// How the direct light varies across a patch, and which cut takes the most of that away.
//
// A leaf carries one radiosity, so what it cannot express is the variance of the light over it. That is measured in 36 points, with shadows
// and half-shadows as they are (LitRegion). A cut leaves two parts, each with a mean of its own, and takes away the variance between the
// two. Two kinds of cuts are compared by that: along a critical line that crosses the patch, and in halves, through its centroid, parallel
// to one of its sides. So the parts of a half-shadow are strips along its edge, over which the light is even.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// Parts are no longer than this many times their width, unless the patch itself is.
inline constexpr double longest_cut_part = 8.0;

// A cut along the plane through a point, its normal in the plane of the patch.
struct CutPlane {
  glm::dvec3 point{0.0}, normal{0.0};
};

// Of a lamp that may be hidden from some of the patch: the share of its light that arrives there.
struct LampSeen {
  std::uint32_t surface = 0;  // the lamp's input surface
  double share = 0.0;
};

struct DirectVariation {
  double square = 0.0;             // mean of the square of the reflected direct light, summed over the channels; (W/m2)^2
  double variance = 0.0;           // of that light, likewise
  std::optional<CutPlane> halves;  // nothing: no cut leaves parts of sound proportion
  std::optional<CutPlane> along;   // a critical line, where that takes away half of what cutting in halves does, at least
  std::vector<LampSeen> seen;
};

// Of a flat patch with area, whose points `region` is made for.
[[nodiscard]] DirectVariation direct_variation(LitRegion& region, const Patch& patch, const Color& reflectance,
                                               const std::vector<CriticalLine>& lines);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/discontinuity/direct_variation.cpp>
#endif
