// SPDX-License-Identifier: MIT
#pragma once

// What the entities of MGF say of colours and materials: c with cxy, cspec, cct, cmix; m with sides, rd, ed. Mirrors and glass are noted.

#include <cstdint>

#include "apps/input_errors.hpp"
#include "apps/intake/mgf_contexts.hpp"
#include "apps/intake/mgf_transform.hpp"
#include "apps/intake/model.hpp"

namespace apps::intake::mgf {

class Looks {
 public:
  Looks(Model& model, Notes& notes) : model_{model}, notes_{notes} {}

  // Carries the line out; false when its entity is none of these.
  bool take(const Line& line, Errors& errors);

  // The current material's number in the model.
  [[nodiscard]] std::uint32_t material();

 private:
  void choose_color(const Line& line, Errors& errors) { colors_.choose(line, errors); }
  void chromaticity(const Line& line, Errors& errors);
  void temperature(const Line& line, Errors& errors);
  void spectrum(const Line& line, Errors& errors);
  void mixture(const Line& line, Errors& errors);
  void choose_material(const Line& line, Errors& errors);
  void sides(const Line& line, Errors& errors) { changed().two_sided = number(line, 1, errors) != 1.0; }
  void reflectance(const Line& line, Errors& errors);
  void emission(const Line& line, Errors& errors);
  void mirror_or_glass(const Line& line, Errors& errors);

  void set_color(const glm::dvec3& xyz);
  Material& changed();

  Model& model_;
  Notes& notes_;
  Contexts<Chroma> colors_{"colour"};
  Contexts<Material> materials_{"material"};
};

}  // namespace apps::intake::mgf
