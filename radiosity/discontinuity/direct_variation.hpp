// SPDX-License-Identifier: MIT
#pragma once

// How the direct light varies across a patch, and where a cut takes the most of that away.
//
// The light of the lamps is known before anything is solved (DirectLight), shadows and penumbrae included. It is looked at in 36 points of
// the patch; a leaf carries one radiosity, so what it cannot express is their variance. A cut at a line leaves two parts with means of
// their own, and takes the variance between them away. Lines that are tried: the critical lines that cross the patch, and through its
// centroid the parallels to its sides; so parts of long strips are strips, as the light is.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// A cut along the plane through a point.
struct CutPlane {
  glm::dvec3 point{0.0}, normal{0.0};
};

struct PatchVariation {
  double variance = 0.0;  // of the reflected direct light, over the patch, all channels
  CutPlane cut;           // normal 0: none is left that makes both parts proper
};

// Parts are no longer than this many times their width.
inline constexpr double longest_cut_part = 8.0;

// Of a patch on a flat object. `region` is that of the patch.
[[nodiscard]] PatchVariation patch_variation(LitRegion& region, const Patch& patch, const Color& reflectance,
                                             const std::vector<CriticalLine>& lines);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/discontinuity/direct_variation.cpp>
#endif
