// SPDX-License-Identifier: MIT
#pragma once

// Colours of MGF are CIE (1931) x y chromaticities, and amounts of light are photometric.

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>

namespace apps::intake::mgf {

// Lumens of one watt of white light, by the definition of the format.
inline constexpr double white_efficacy = 179.0;

// The colour of this chromaticity with Y = 1: shares of primaries with the chromaticities of sRGB whose white is that of the format, the
// equal-energy one (1/3, 1/3). What these cannot show is clamped.
[[nodiscard]] inline radiosity::Color color_of(double x, double y) {
  const auto xyz = [](double u, double v) { return glm::dvec3(u / v, 1.0, (1.0 - u - v) / v); };
  const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
  const glm::dvec3 white = glm::inverse(primaries) * glm::dvec3(1.0);
  return glm::max(glm::inverse(primaries) * xyz(x, y) / white, glm::dvec3(0.0));
}

}  // namespace apps::intake::mgf
