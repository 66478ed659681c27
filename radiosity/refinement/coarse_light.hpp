// SPDX-License-Identifier: MIT
#pragma once

// A coarse solution over evaluated links, to judge where light matters: grey (the brightest channel), with constant light over both ends
// of a link, diffuse clusters, and only a few reflections. It takes one pass over the links per reflection, some per cent of the time of
// their evaluation.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

struct CoarseLight {
  std::vector<double> radiosity;    // by node; area average for inner nodes and clusters
  std::vector<double> reflectance;  // by input surface
  double reflected_square = 0.0;    // sum over the leaves of area times squared reflected radiosity
};

// Requires the exposed areas of all nodes.
[[nodiscard]] CoarseLight coarse_light(const DiscreteScene& scene, const Links& links, std::uint32_t reflections);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/coarse_light.cpp>
#endif
