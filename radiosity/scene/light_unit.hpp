// SPDX-License-Identifier: MIT
#pragma once

// The unit of light in which a run computes: a power of two for which the strongest emission of the scene is in [1, 2).
//
// Radiosity is linear in the emission, but norms and errors are squares: below 1e-154 W/m2 they would underflow, above 1e154 overflow.
// Scaling by a power of two changes no digit of a result, so every finite emission gives the same relative result.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

// Light in the unit is light in W/m2 times 2^-exponent.
struct LightUnit {
  int exponent = 0;

  [[nodiscard]] Color to_unit(const Color& c) const { return times(c, -exponent); }
  [[nodiscard]] Color to_watts(const Color& c) const { return times(c, exponent); }

 private:
  [[nodiscard]] static Color times(const Color& c, int power) {
    return {std::ldexp(c.x, power), std::ldexp(c.y, power), std::ldexp(c.z, power)};
  }
};

// The unit for the materials that objects use; W/m2 if none of them emits. The scene must be valid.
[[nodiscard]] inline LightUnit light_unit(const Scene& scene) {
  double strongest = 0.0;
  for (const SceneObject& object : scene.objects) {
    for (const std::uint32_t m : object.material) {
      const Color& e = scene.materials[m].emission;
      strongest = std::max(strongest, brightest(e));
    }
  }
  return strongest > 0.0 ? LightUnit{std::ilogb(strongest)} : LightUnit{};
}

[[nodiscard]] inline Scene in_unit(Scene scene, const LightUnit& unit) {
  for (Material& material : scene.materials) { material.emission = unit.to_unit(material.emission); }
  return scene;
}

}  // namespace radiosity
