// SPDX-License-Identifier: MIT
#pragma once

// The form factors of a scene that must have them.

#include <utility>

#include <radiosity/factors/factors.hpp>

#include "catch.hpp"

namespace scenes {

inline radiosity::Factors factors_of(const radiosity::Scene& scene, double error = 1e-3, unsigned threads = 1) {
  const radiosity::FactorOptions options{.error = error, .threads = threads};
  radiosity::FactorsResult result = radiosity::factors(scene, options);
  REQUIRE(result.factors);
  return std::move(*result.factors);
}

// A scene still without objects, and its one material.
inline radiosity::Scene grey() { return {{{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}}, {}}; }

}  // namespace scenes
