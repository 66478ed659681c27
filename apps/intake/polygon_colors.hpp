// SPDX-License-Identifier: MIT
#pragma once

// Colours that differ between the polygons of one material: vertex colours, or the part of a picture on each polygon. The solver has one
// reflectance and one emission per surface, so a polygon gets the mean of its part and a material of its own.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <radiosity/scene/material.hpp>

#include "apps/intake/model.hpp"
#include "apps/intake/texture.hpp"

namespace apps::intake {

class PolygonColors {
 public:
  enum class Of : std::uint8_t { reflectance, emission };

  // The reflectance or emission of the material is multiplied by this picture; null has no effect. `place`: where the file says so.
  void picture(std::uint32_t material, Of of, std::shared_ptr<const Picture> picture, std::string place);
  // The reflectance of the last polygon of the model is multiplied by this colour.
  void tint(const Model& model, const radiosity::Color& color);
  // The texture coordinates of the last polygon of the model, one per corner.
  void lies_at(const Model& model, std::span<const glm::dvec2> corners);

  // Applies all factors; to be called when all polygons and materials are complete. A picture counts with its mean colour on the
  // polygons or, if it varies more between polygons than within them (an atlas, a palette, fine triangles), with the mean of its part on
  // each. Where a picture of emission is dark, polygons do not shine, as around the lights of a device. If a material has more than 256
  // colours of one kind, those closer than a sixteenth in sRGB are merged.
  void apply(Model& model, Notes& notes);

 private:
  struct Laid {
    std::shared_ptr<const Picture> picture;
    std::string place;
  };
  using Factors = std::array<radiosity::Color, 2>;  // of reflectance and emission

  void lay(Of of, Model& model, std::vector<Factors>& factors, Notes& notes) const;

  std::vector<std::array<Laid, 2>> pictures_;  // by material
  std::vector<radiosity::Color> tints_;        // by polygon, may be shorter than their number; NaN: none
  std::vector<glm::vec2> places_;              // by corner, may be shorter than their number
};

}  // namespace apps::intake
