// SPDX-License-Identifier: MIT
#pragma once

// Runs a solver in the scene's own unit of light (light_unit.hpp) and converts the result to W/m2. Every result field with light must be
// converted here.

#include <string>
#include <utility>
#include <vector>

#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

namespace detail {

// Convert from the unit to W/m2; return false if a value exceeds the range of double.
[[nodiscard]] bool to_watts(Mesh& mesh, const LightUnit& unit);
[[nodiscard]] bool to_watts(Solution& solution, const LightUnit& unit);

// The outcome of `solve` on the scene in its own unit of light, converted to W/m2.
template <class Solve>
[[nodiscard]] Outcome solve_in_own_unit(const Scene& scene, const Solve& solve) {
  std::vector<std::string> sentences = faults(scene);
  if (!sentences.empty()) { return failed(Failure::Kind::invalid_scene, std::move(sentences)); }
  const LightUnit unit = light_unit(scene);
  Outcome outcome = solve(in_unit(scene, unit), unit);
  if (outcome.solution && !to_watts(*outcome.solution, unit)) {
    return failed(Failure::Kind::invalid_scene, {"the light is stronger than a number can hold; give the emissions in a larger unit"});
  }
  return outcome;
}

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/result/own_unit.cpp>
#endif
