// SPDX-License-Identifier: MIT
#pragma once

// Gathered light at a place by independent families of rays: its mean, and the standard error that their spread tells.

#include <cmath>
#include <cstdint>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/support/random.hpp>

namespace scenes {

struct OfFamilies {
  double mean = 0.0, standard_error = 0.0;  // of the irradiance in the first channel
};
inline constexpr int families = 64;
inline constexpr std::uint32_t rays_of_family = 1024;

inline OfFamilies gathered(const radiosity::FinalGather& light, const radiosity::FinalGather::Place& place, std::uint64_t seed) {
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t key = 0; key < families; ++key) {
    const double value = light.indirect(place, {rays_of_family, rays_of_family, 0.0}, radiosity::scramble(seed) + key).irradiance.x;
    sum += value / families;
    squares += value * value / families;
  }
  return {sum, std::sqrt((squares - sum * sum) / (families - 1))};
}

}  // namespace scenes
