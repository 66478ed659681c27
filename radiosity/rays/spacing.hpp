// SPDX-License-Identifier: MIT
#pragma once

// How large a patch may be for light that comes from everywhere, and how much that light matters there: over a node of radius r that sees
// things at the harmonic mean distance R, such light changes by some r / R of itself (Ward, Rubinstein and Clear 1988). So corners and
// contacts want small nodes, and the middle of a wall large ones; and where what is seen is dark, neither matters.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/oracle/importance.hpp>
#include <radiosity/rays/senders.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

struct SpacingResult {
  std::vector<Caster> casters;
  std::uint32_t generations = 0;
  std::uint64_t rays = 0;
  bool cancelled = false;
  std::uint64_t too_large = 0;  // bytes that would be needed, at least, when that is more than the budget allows
};

// Descends from the input faces, and splits leaves of more than `min_area` (relative to the exposed area of all input faces), until for
// each node r / R times the light that it reflects, relative to the scene, times the root of its share of that area is at most
// `tolerance`: what each adds to the L2 error is then about the same. R and that light are found by 16 rays. Lamps are left as they are,
// and what is buried. Then casters are split as senders (senders.hpp), to a third of the tolerance: what one sends is wrong for all that
// see it in the same sense. `of_lamps`: evaluated links that carry the light of all lamps; an end that was a leaf and is split gets its
// gradient. By `importance`, which takes in the nodes that are made, errors count by their weight, and uneven nodes are split.
[[nodiscard]] SpacingResult space_casters(DiscreteScene& scene, Links& of_lamps, Importance& importance, double tolerance, double min_area);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/spacing.cpp>
#endif
