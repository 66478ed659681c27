// SPDX-License-Identifier: MIT
#pragma once

// Panes: surfaces of materials that let most light through, such as the glass of a window, and surfaces that are not seen at all. The
// solver knows no transmission, so a pane is either opaque or absent. Absent is closer: light comes through windows.
//
// A material that shines makes no panes. If nothing else is in the file, the panes remain, because its author wanted them to be seen.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/intake/model.hpp"

namespace apps {

class Panes {
 public:
  Panes() = default;
  // `materials`: those of the model, with the emission that they have in the scene.
  Panes(const Model& model, std::span<const radiosity::Material> materials);

  // Is the object, one of the model's, a pane?
  [[nodiscard]] bool has(const radiosity::SceneObject& object) const;
  // What is left out, and how to keep it; empty: nothing.
  [[nodiscard]] std::string sentence(const Model& model) const;

  // The polygons of the model that are not panes; both must outlive the view.
  [[nodiscard]] radiosity::PolygonView others(const Model& model, std::span<const std::uint8_t> two_sided) const;
  // Polygons of the result are counted among the others; afterwards as in the model. A pane became nothing.
  void renumber(radiosity::Intake& intake) const;

 private:
  std::vector<std::uint8_t> of_material_;   // is the material one of panes? Empty: there are none
  std::size_t polygons_ = 0, objects_ = 0;  // panes
  // If there are panes among the polygons: the others, and the number of each in the model.
  std::vector<std::uint32_t> number_, corners_, first_corner_{0}, material_, group_;
};

}  // namespace apps
