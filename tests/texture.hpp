// SPDX-License-Identifier: MIT
#pragma once

// A texture as a graphics card reads it.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "catch.hpp"

namespace texture {

// Bilinear, between the middles of texels. The place must have four texels around it.
template <class Texel>
glm::dvec3 sample(const std::vector<Texel>& texels, std::size_t width, std::size_t height, const glm::dvec2& at) {
  const glm::dvec2 place = at * glm::dvec2(width, height) - 0.5;
  glm::dvec3 sum(0.0);
  for (int k = 0; k < 4; ++k) {
    const double x = std::floor(place.x) + k % 2, y = std::floor(place.y) + k / 2;
    REQUIRE((x >= 0.0 && y >= 0.0 && x < static_cast<double>(width) && y < static_cast<double>(height)));
    const double weight = (1.0 - std::abs(place.x - x)) * (1.0 - std::abs(place.y - y));
    sum += weight * glm::dvec3(texels[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)]);
  }
  return sum;
}

}  // namespace texture
