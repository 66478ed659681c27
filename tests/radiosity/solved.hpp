// SPDX-License-Identifier: MIT
#pragma once

// The solution of a run that must have one.

#include <utility>

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

}  // namespace scenes
