// SPDX-License-Identifier: MIT
#pragma once

// Colours by which the polygons of one material differ: those of their vertices, or of the part of a picture that lies on them. The solver
// has one reflectance and one emission for each surface, so a polygon gets the mean of its part, and a material of its own.

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

  // What a material reflects or emits is to be multiplied with this picture; null: nothing happens. `place`: where the file says so.
  void picture(std::uint32_t material, Of of, std::shared_ptr<const Picture> picture, std::string place);
  // The reflectance of the polygon that was last added to the model is to be multiplied with this colour.
  void tint(const Model& model, const radiosity::Color& color);
  // Where the corners of the polygon that was last added to the model lie in its pictures, one for each corner.
  void lies_at(const Model& model, std::span<const glm::dvec2> corners);

  // Multiplies, once all polygons and materials are there. A picture counts with its mean colour, or, when it tells polygons apart by more
  // than it varies within them (an atlas, a palette, fine triangles), with the mean of the part on each of them. Of more than 256 colours
  // of one material those that are closer than a sixteenth in sRGB become one.
  void apply(Model& model, Notes& notes);

 private:
  struct Laid {
    std::shared_ptr<const Picture> picture;
    std::string place;
  };
  using Factors = std::array<radiosity::Color, 2>;  // of reflectance and emission

  void lay(Of of, Model& model, std::vector<Factors>& factors, Notes& notes) const;

  std::vector<std::array<Laid, 2>> pictures_;  // by material
  std::vector<radiosity::Color> tints_;        // by polygon, as far as there are any; NaN: none
  std::vector<glm::vec2> places_;              // by corner, as far as there are any
};

}  // namespace apps::intake
