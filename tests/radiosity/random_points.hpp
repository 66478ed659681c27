// SPDX-License-Identifier: MIT
#pragma once

// Random numbers and points for scenes of tests.

#include <random>

#include <glm/vec3.hpp>

namespace scenes {

inline double uniform(std::mt19937_64& random, double lo, double hi) { return std::uniform_real_distribution<double>{lo, hi}(random); }

// In the cube from `lo` to `hi`.
inline glm::dvec3 point(std::mt19937_64& random, double lo, double hi) {
  const double x = uniform(random, lo, hi), y = uniform(random, lo, hi);
  return {x, y, uniform(random, lo, hi)};
}

}  // namespace scenes
