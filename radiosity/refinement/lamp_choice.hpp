// SPDX-License-Identifier: MIT
#pragma once

// What counts as a lamp: it shines so much brighter than all surfaces do in the mean that its light is looked after link by link.

#include <vector>

#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// What shines at most so much brighter than all surfaces do in the mean is no lamp where faces that shine are many: rays find it.
inline constexpr double least_lamp_contrast = 4.0;

// Of each input surface: does it shine far brighter than all do in the mean? In the open the mean is that over the box around the scene:
// rays seldom meet what is small in it.
[[nodiscard]] std::vector<bool> choose_lamps(const DiscreteScene& scene);

// The nodes of such surfaces, and the clusters of nothing else. Empty if there are none.
[[nodiscard]] std::vector<bool> lamp_nodes(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/lamp_choice.cpp>
#endif
