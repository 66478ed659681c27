// SPDX-License-Identifier: MIT
#pragma once

// The solution of a run that must have one, and what those who ask about its light need.

#include <cstdint>
#include <utility>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/radiosity.hpp>

#include "catch.hpp"

namespace scenes {

inline radiosity::Solution solved(radiosity::Outcome outcome) {
  for (const std::string& sentence : outcome.failure.sentences) { UNSCOPED_INFO(sentence); }
  REQUIRE(outcome.solution);
  return std::move(*outcome.solution);
}
inline radiosity::Solution solved(const radiosity::Scene& scene, const radiosity::Options& options,
                                  const radiosity::Control& control = {}) {
  return solved(radiosity::solve(scene, options, control));
}

// The unrefined boundaries of all objects.
inline std::vector<radiosity::Surface> boundaries(const raycast::Scene& objects) {
  std::vector<radiosity::Surface> result;
  for (std::uint32_t o = 0, first = 0; o < objects.size(); first += objects.object(o++).sheet_count()) {
    result.push_back(std::move(*radiosity::make_surface(objects.object(o), first).surface));
  }
  return result;
}

}  // namespace scenes
