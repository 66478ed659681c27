// SPDX-License-Identifier: MIT
#pragma once

// A coarse solution over evaluated links, to judge by where light matters: grey (the brightest channel), every link as if it were even
// over both its ends, clusters as if they were diffuse, and no light that was reflected more than a few times. One pass over the links a
// reflection, so it costs some per cent of what their evaluation does.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

struct CoarseLight {
  std::vector<double> radiosity;    // of each node; of inner nodes and clusters the area average
  std::vector<double> reflectance;  // of each input surface
  double reflected_square = 0.0;    // sum over the leaves of area times the square of what they reflect
};

// Needs the exposed areas of all nodes.
[[nodiscard]] CoarseLight coarse_light(const DiscreteScene& scene, const Links& links, std::uint32_t reflections);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/coarse_light.cpp>
#endif
