// SPDX-License-Identifier: MIT
#pragma once

// What a surface does with light. Every surface is an ideal diffuse (Lambertian) reflector, as in the paper (section 3),
// described by its reflectance rho in [0,1] and its own emission E, per channel.
//
// Units: emission and radiosity are exitances in W/m2. Radiance of a diffuse surface is B / pi.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include <radiosity/support/number_text.hpp>

namespace radiosity {

// One value per channel: red, green, blue.
using Color = glm::dvec3;

struct Material {
  std::string name;
  Color reflectance{0.0};  // rho, each channel in [0,1]
  Color emission{0.0};     // E, W/m2, each channel >= 0 and finite
};

// A sentence that says what is wrong with the material, or nothing if it is valid.
[[nodiscard]] inline std::optional<std::string> fault(const Material& material) {
  for (int c = 0; c < 3; ++c) {
    const double rho = material.reflectance[c];
    const double emission = material.emission[c];
    if (!(rho >= 0.0 && rho <= 1.0)) {
      return "material '" + material.name + "': reflectance " + number_text(rho) +
             " lies outside [0, 1]; a surface cannot reflect more than it receives";
    }
    if (!(emission >= 0.0 && std::isfinite(emission))) {
      return "material '" + material.name + "': emission " + number_text(emission) + " is not a finite number from 0 on";
    }
  }
  return std::nullopt;
}

[[nodiscard]] inline bool is_grey(const Color& c) { return c.x == c.y && c.y == c.z; }

[[nodiscard]] inline double brightest(const Color& c) { return std::max({c.x, c.y, c.z}); }
[[nodiscard]] inline double sum_of_channels(const Color& c) { return c.x + c.y + c.z; }
[[nodiscard]] inline bool is_black(const Color& c) { return c.x == 0.0 && c.y == 0.0 && c.z == 0.0; }

}  // namespace radiosity
