// SPDX-License-Identifier: MIT
#pragma once

// How large a leaf may be for light that comes from everywhere: over a leaf of radius r that sees things at the harmonic mean distance R,
// such light changes by some r / R of itself (Ward, Rubinstein and Clear 1988), so corners and contacts want small leaves, and the
// middle of a wall large ones.

#include <cstdint>
#include <vector>

#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

struct SpacingResult {
  std::vector<std::uint32_t> spaced;  // the leaves when it was done, but for lamps
  std::uint32_t generations = 0;
  std::uint64_t rays = 0;
  bool cancelled = false;
  std::uint64_t too_large = 0;  // bytes that would be needed, at least, when that is more than the budget allows
};

// Splits leaves of more than `min_area` (relative to the area of all input faces that are not buried) until, for each, r / R times the
// root of its share of that area is at most `tolerance`: what each leaf adds to the L2 error is then about the same. Lamps are left as they
// are. R is found by 16 rays.
[[nodiscard]] SpacingResult split_by_distance(DiscreteScene& scene, double tolerance, double min_area);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/spacing.cpp>
#endif
