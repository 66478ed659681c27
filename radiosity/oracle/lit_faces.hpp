// SPDX-License-Identifier: MIT
#pragma once

// The input faces over which the light of a scene is spread. Errors are relative to the reflected light, and thresholds to the area that
// reflects it. A sun may have a thousand times the area of the house that it lights, and so may a sky; relative to these, the house would
// be smaller than the smallest patch.

#include <cstddef>
#include <span>
#include <vector>

#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/scene_view.hpp>

namespace radiosity {

// This share of a face's own emission is added to the light that falls on it, because an error of the reflected light that is much smaller
// than what the face shows is not seen. Measured on files in which all shines: with 0.1 the errors of the leaves are 1.2 to 2 times as
// large, 0.01 takes two to three times as long.
inline constexpr double own_light = 0.03;

// Faces have weights from 0 to 1. A face that is buried or reflects nothing has weight 0; one that emits at most half of the mean
// emission has weight 1. Brighter faces are weighted by the irradiance H from other emitters, compared with their own emission E:
// H / (E + H). So a sun has nearly no weight, and the walls of a room that all emit alike have equal weights. Weights are scaled so that
// the largest is 1; where that is small, because all faces mostly show their own light, they become alike (own_light). If all are 0, every
// face that is not buried gets 1.
class LitFaces {
 public:
  // `reflectance`, `emission`: by input surface; `buried`: by node (buried.hpp), may be empty.
  LitFaces(const SceneView& scene, std::span<const Color> reflectance, std::span<const Color> emission, const std::vector<bool>& buried);

  // For an input face; 0 for other nodes.
  [[nodiscard]] double weight(std::size_t node) const { return weight_[node]; }
  // Weight of the faces of an input surface that are not buried.
  [[nodiscard]] double weight_of_surface(std::size_t surface) const { return of_surface_[surface]; }
  // Sum of area times weight.
  [[nodiscard]] double area() const { return area_; }
  // Power of all faces that are not buried, each in its brightest channel, divided by area().
  [[nodiscard]] double mean_emission() const { return area_ > 0.0 ? power_ / area_ : 0.0; }
  // The mean emission over area(), divided by mean_emission(): how much of what the faces show is their own light. 1 if all emit alike.
  [[nodiscard]] double own_share() const { return power_ > 0.0 ? own_power_ / power_ : 0.0; }

 private:
  std::vector<double> weight_, of_surface_;
  double area_ = 0.0, power_ = 0.0, own_power_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/lit_faces.cpp>
#endif
