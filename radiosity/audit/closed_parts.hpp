// SPDX-License-Identifier: MIT
#pragma once

// Which surfaces exchange light with each other alone, where no proof says that the scene is closed (visibility/enclosure.hpp): found by
// rays. Things that cross each other or a wall keep most rooms of other programs from being proven closed, and of walls with two sides the
// outer ones lose all their light: the rooms within are closed all the same.

#include <vector>

#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/audit.hpp>

namespace radiosity {

struct ClosedParts {
  StrayRays stray;
  std::vector<bool> surfaces;  // by input surface: does it belong to a closed part? Empty where none does
  bool lossless = false;       // one of the parts emits light of some channel and absorbs none of it
};

// Casts a cosine-distributed ray from each of thousands of points, spread over the exposed area. Surfaces that rays connect are a part;
// it counts as closed where hardly any of its rays meets nothing, or a black back.
[[nodiscard]] ClosedParts find_closed_parts(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/closed_parts.cpp>
#endif
