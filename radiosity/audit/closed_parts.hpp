// SPDX-License-Identifier: MIT
#pragma once

// Finds by rays which input faces exchange light only with each other, where no proof says that the scene is closed
// (visibility/enclosure.hpp). In models of other programs objects cross each other or a wall, so most rooms cannot be proven closed; and
// the outer sides of two-sided walls lose all their light. The rooms within are closed all the same. A wall that is longer than its room
// continues outside, where other walls cross it; wall_cuts.hpp has cut it there, so that only one of the resulting input faces belongs to
// the room.
//
// A lamp panel under a ceiling is black from behind. A room with such lamps loses light there alone, so that all patches in front of the
// planes of these panels, the floor and most of the walls, still have row sums of 1.

#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>

namespace radiosity {

struct ClosedParts {
  StrayRays stray;
  PartsWithoutLoss nodes;  // empty if no node is known to lose no light
  bool lossless = false;   // does one of the parts emit light in some channel and absorb none of it?
};

// Casts a cosine-distributed ray from each of thousands of points, spread over the exposed area. Input faces connected by rays form a
// part, which counts as closed if hardly any of its rays leaves the scene or hits a black back. If they only hit backs that lie in a few
// planes, those patches of the part count which lie in front of all these planes. An input face in a part with too few rays is classified
// like the other faces of its surface, if those agree.
[[nodiscard]] ClosedParts find_closed_parts(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/closed_parts.cpp>
#endif
