// SPDX-License-Identifier: MIT
#pragma once

// Converts radiosity to the values that a screen shows.
//
// A diffuse surface of radiosity B (W/m2) has the radiance B / pi (W/m2/sr) in every direction. The value shown is exposure * B / pi,
// passed through the tone curve, clamped to [0,1] and encoded by the sRGB transfer function (IEC 61966-2-1), 8 bits per channel.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>

#include <radiosity/scene/material.hpp>

namespace radiosity {

using Rgb8 = std::array<std::uint8_t, 3>;

// Encodes linear light in [0, 1] to a value in [0, 1].
[[nodiscard]] inline double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// The inverse.
[[nodiscard]] inline double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// linear: brightness is proportional to light up to 1. filmic: dark tones get more contrast, bright ones approach 1 slowly, as on film;
// 0.8 is shown as 0.75 (Narkowicz 2015, a fit of the ACES reference curve).
enum class ToneCurve { linear, filmic };
inline constexpr const char* name(ToneCurve curve) { return curve == ToneCurve::linear ? "linear" : "filmic"; }

struct Tone {
  double exposure = 1.0;  // factor from radiance to the value shown
  ToneCurve curve = ToneCurve::linear;

  constexpr Tone(double exposure_ = 1.0, ToneCurve curve_ = ToneCurve::linear) : exposure{exposure_}, curve{curve_} {}

  [[nodiscard]] double operator()(double radiosity) const {
    const double x = std::max(0.0, radiosity * (exposure / std::numbers::pi));
    if (curve == ToneCurve::linear || !(x < 1e6)) { return std::min(x, 1.0); }
    return std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
  }
  // The linear values in [0,1] of a radiosity.
  [[nodiscard]] Color operator()(const Color& radiosity) const {
    return {(*this)(radiosity.x), (*this)(radiosity.y), (*this)(radiosity.z)};
  }
};

// Relative luminance of linear sRGB (ITU-R BT.709).
[[nodiscard]] inline double luminance(const Color& linear) { return glm::dot(linear, Color{0.2126, 0.7152, 0.0722}); }

[[nodiscard]] inline std::uint8_t to_byte(double linear) { return static_cast<std::uint8_t>(std::lround(255.0 * srgb_encode(linear))); }

[[nodiscard]] inline Rgb8 to_rgb8(const Color& linear) { return {to_byte(linear.x), to_byte(linear.y), to_byte(linear.z)}; }

}  // namespace radiosity
