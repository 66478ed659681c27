// SPDX-License-Identifier: MIT
#pragma once

// Colours of MGF are CIE (1931) xy chromaticities, spectra, black-body temperatures, and mixtures; amounts of light are photometric.

#include <cmath>
#include <cstddef>
#include <span>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>

namespace apps::intake::mgf {

// Lumens per watt of white light, by definition of the format.
inline constexpr double white_efficacy = 179.0;

// The colour of this chromaticity with Y = 1, in primaries with the chromaticities of sRGB but the white of the format, which is the
// equal-energy one (1/3, 1/3). Colours outside the gamut are clamped.
[[nodiscard]] inline radiosity::Color color_of(double x, double y) {
  const auto xyz = [](double u, double v) { return glm::dvec3(u / v, 1.0, (1.0 - u - v) / v); };
  const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
  const glm::dvec3 white = glm::inverse(primaries) * glm::dvec3(1.0);
  return glm::max(glm::inverse(primaries) * xyz(x, y) / white, glm::dvec3(0.0));
}

// The CIE 1931 colour matching functions as sums of Gaussian lobes (Wyman, Sloan and Shirley 2013, errors of 1 to 2 % of their maxima);
// wavelength in nm.
[[nodiscard]] inline glm::dvec3 matching(double wavelength) {
  const auto lobe = [&](double middle, double below, double above) {
    const double t = (wavelength - middle) / (wavelength < middle ? below : above);
    return std::exp(-0.5 * t * t);
  };
  return {1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
          0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
          1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
}

// X Y Z of a spectrum (a function of nm), scaled so that a constant spectrum has 1 1 1, the white of the format.
template <class Spectrum>
[[nodiscard]] glm::dvec3 xyz_of(const Spectrum& spectrum) {
  glm::dvec3 sum(0.0), even(0.0);
  for (double wavelength = 360.0; wavelength <= 830.0; wavelength += 1.0) {
    sum += spectrum(wavelength) * matching(wavelength);
    even += matching(wavelength);
  }
  return sum / even;
}

// The same for values at equal distances from `first` to `last` nm; beyond these the spectrum is 0, by definition of the format.
[[nodiscard]] inline glm::dvec3 xyz_of_samples(std::span<const double> values, double first, double last) {
  return xyz_of([&](double wavelength) {
    const double place = (wavelength - first) / (last - first) * static_cast<double>(values.size() - 1);
    if (!(place >= 0.0 && place <= static_cast<double>(values.size() - 1))) { return 0.0; }
    const auto i = static_cast<std::size_t>(place);
    return i + 1 == values.size() ? values[i] : glm::mix(values[i], values[i + 1], place - static_cast<double>(i));
  });
}

// The same for a black body (Planck 1900), temperature in kelvin; up to a factor.
[[nodiscard]] inline glm::dvec3 xyz_of_temperature(double kelvin) {
  constexpr double second_constant = 1.438776877e7;  // nm K
  const auto exponent = [&](double wavelength) { return second_constant / (wavelength * kelvin); };
  return xyz_of([&](double wavelength) {  // relative to 560 nm, so that no factor overflows
    return std::pow(560.0 / wavelength, 5.0) * std::exp(exponent(560.0) - exponent(wavelength)) * std::expm1(-exponent(560.0)) /
           std::expm1(-exponent(wavelength));
  });
}

}  // namespace apps::intake::mgf
