// SPDX-License-Identifier: MIT
#pragma once

// Finds by rays which input faces exchange light only with each other, where no proof says that the scene is closed
// (visibility/enclosure.hpp). In models of other programs objects cross each other or a wall, so most rooms cannot be proven closed; and
// the outer sides of two-sided walls lose all their light. The rooms within are closed all the same. A wall that is longer than its room
// continues outside, where other walls cross it; wall_cuts.hpp has cut it there, so that only one of the resulting input faces belongs to
// the room.

#include <vector>

#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>

namespace radiosity {

struct ClosedParts {
  StrayRays stray;
  std::vector<bool> nodes;  // by node: does its input face belong to a closed part? Empty if there is no closed part
  bool lossless = false;    // does one of the parts emit light in some channel and absorb none of it?
};

// Casts a cosine-distributed ray from each of thousands of points, spread over the exposed area. Input faces connected by rays form a
// part, which counts as closed if hardly any of its rays leaves the scene or hits a black back. An input face in a part with too few rays
// is classified like the other faces of its surface, if those agree.
[[nodiscard]] ClosedParts find_closed_parts(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/closed_parts.cpp>
#endif
