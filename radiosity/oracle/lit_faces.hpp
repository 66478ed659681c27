// SPDX-License-Identifier: MIT
#pragma once

// The input faces over which the light of a scene is spread. Errors are relative to the light that surfaces reflect, and thresholds to the
// area that reflects it. A sun has a thousand times the area of the house before it, and a sky as much: relative to those the house would
// be smaller than the smallest patch.

#include <cstddef>
#include <span>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/scene_view.hpp>

namespace radiosity {

// Faces count by weights from 0 to 1. What is buried or reflects nothing has 0; what shines at most half as much as the mean has 1. Towards
// the mean and beyond it a face counts as far as what falls on it from others that shine, H, is much beside what it emits, E: H / (E + H).
// So a sun has next to nothing, and the walls of a room that shine all alike have as much as each other. The largest weight is made 1.
// Where all weights are 0, whatever is not buried has 1.
class LitFaces {
 public:
  // `reflectance`, `emission`: of each input surface; `buried`: by node (buried.hpp), or none when it is empty.
  LitFaces(const SceneView& scene, std::span<const Color> reflectance, std::span<const Color> emission, const std::vector<bool>& buried);

  // Of an input face; 0 of other nodes.
  [[nodiscard]] double weight(std::size_t node) const { return weight_[node]; }
  // Of what is not buried of an input surface.
  [[nodiscard]] double weight_of_surface(std::size_t surface) const { return of_surface_[surface]; }
  // Sum of areas, each times its weight.
  [[nodiscard]] double area() const { return area_; }
  // Of all faces that are not buried, in the brightest channel of each, over the area above.
  [[nodiscard]] double mean_emission() const { return area_ > 0.0 ? power_ / area_ : 0.0; }

 private:
  std::vector<double> weight_, of_surface_;
  double area_ = 0.0, power_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/lit_faces.cpp>
#endif
