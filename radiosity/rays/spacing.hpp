// SPDX-License-Identifier: MIT
#pragma once

// Chooses the size of casting nodes for indirect light. Over a node of radius r that sees things at the harmonic mean distance R, such
// light changes by a fraction of about r / R (Ward, Rubinstein and Clear 1988). So corners and contacts need small nodes, and the middle
// of a wall large ones; where what is seen is dark, the error does not matter.

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
  std::uint64_t too_large = 0;  // lower bound of the bytes needed, if that exceeds the budget
};

// Descends from the input faces, splitting leaves larger than `min_area` (relative to the exposed area of all input faces, where suns and
// skies count as if they stood close around the rest), until each node satisfies: r / R, times its reflected light relative to the scene,
// times the square root of its share of that area, is at most `tolerance`. Then all nodes add about the same to the L2 error. R and the
// light are sampled by 16 rays. Lamps and buried nodes are not changed. After that casters are split as senders (senders.hpp) with a third
// of the tolerance, because the error of a sender has the same sign at all places that see it. `of_lamps`: evaluated links that carry the
// light of all lamps; if an end that was a leaf is split, the link gets its gradient there. `importance` is extended to new nodes; errors
// are weighted by it, and uneven nodes are split.
[[nodiscard]] SpacingResult space_casters(DiscreteScene& scene, Links& of_lamps, Importance& importance, double tolerance, double min_area);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/spacing.cpp>
#endif
