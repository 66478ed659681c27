// SPDX-License-Identifier: MIT
#pragma once

// From radiosity to what a screen shows.
//
// A diffuse surface of radiosity B (W/m2) has the radiance B / pi in every direction. The value shown is
// exposure * B / pi, clamped to [0,1] and encoded by the sRGB transfer function (IEC 61966-2-1), 8 bits per channel.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <radiosity/scene/material.hpp>

namespace apps {

using Rgb8 = std::array<std::uint8_t, 3>;

// Linear light in [0,1] to the encoded value in [0,1].
[[nodiscard]] inline double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// The linear value in [0,1] of a radiosity under an exposure.
[[nodiscard]] inline radiosity::Color shown(const radiosity::Color& radiosity, double exposure) {
  radiosity::Color result(0.0);
  for (int c = 0; c < 3; ++c) { result[c] = std::clamp(radiosity[c] * (exposure / std::numbers::pi), 0.0, 1.0); }
  return result;
}

[[nodiscard]] inline std::uint8_t to_byte(double linear) { return static_cast<std::uint8_t>(std::lround(255.0 * srgb_encode(linear))); }

[[nodiscard]] inline Rgb8 to_rgb8(const radiosity::Color& linear) { return {to_byte(linear.x), to_byte(linear.y), to_byte(linear.z)}; }

}  // namespace apps
