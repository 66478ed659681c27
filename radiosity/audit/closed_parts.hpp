// SPDX-License-Identifier: MIT
#pragma once

// Which input faces exchange light with each other alone, where no proof says that the scene is closed (visibility/enclosure.hpp): found by
// rays. Things that cross each other or a wall keep most rooms of other programs from being proven closed, and of walls with two sides the
// outer ones lose all their light: the rooms within are closed all the same. A wall that is longer than its room goes on outside, where
// other walls cross it; there it was cut (wall_cuts.hpp), and of its input faces one is in the room.

#include <vector>

#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>

namespace radiosity {

struct ClosedParts {
  StrayRays stray;
  std::vector<bool> nodes;  // by node: does its input face belong to a closed part? Empty where none does
  bool lossless = false;    // one of the parts emits light of some channel and absorbs none of it
};

// Casts a cosine-distributed ray from each of thousands of points, spread over the exposed area. Input faces that rays connect are a part;
// it counts as closed where hardly any of its rays meets nothing, or a black back. An input face of a part that too few rays know counts as
// the others of its surface do, where those agree.
[[nodiscard]] ClosedParts find_closed_parts(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/closed_parts.cpp>
#endif
