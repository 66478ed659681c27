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

namespace radiosity {

// All that are not buried, reflect something and shine less than the mean of those that are not buried; or all of these where there are no
// such.
class LitFaces {
 public:
  // `reflectance`, `emission`: of each input surface; `buried`: by node (buried.hpp), or none when it is empty.
  LitFaces(const Hierarchy& hierarchy, std::span<const Color> reflectance, std::span<const Color> emission,
           const std::vector<bool>& buried);

  [[nodiscard]] bool operator()(std::size_t i) const { return counts_[i]; }
  [[nodiscard]] double area() const { return area_; }
  // Of all faces that are not buried, in the brightest channel of each, over the area above.
  [[nodiscard]] double mean_emission() const { return area_ > 0.0 ? power_ / area_ : 0.0; }

 private:
  std::vector<bool> counts_;  // by node
  double area_ = 0.0, power_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/lit_faces.cpp>
#endif
