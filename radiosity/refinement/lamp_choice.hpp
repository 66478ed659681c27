// SPDX-License-Identifier: MIT
#pragma once

// Defines lamps: surfaces so much brighter than the mean that their light is carried by links, not by rays.

#include <vector>

#include <raycast/box.hpp>

#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// If many faces emit, those of at most this multiple of the mean emission are not lamps, because rays find them.
inline constexpr double least_lamp_contrast = 4.0;

// By input surface: is it a lamp? In an open scene the mean emission is taken over the box around the scene, because rays rarely hit a
// small emitter in it.
[[nodiscard]] std::vector<bool> choose_lamps(const DiscreteScene& scene);
// The same from the area and the emission of each input surface, and the box around the scene.
[[nodiscard]] std::vector<bool> choose_lamps(const std::vector<double>& areas, const std::vector<Color>& emission,
                                             const raycast::Box& bounds);

// The nodes of lamps, and the clusters that contain nothing else. Empty if there are none.
[[nodiscard]] std::vector<bool> lamp_nodes(const DiscreteScene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/lamp_choice.cpp>
#endif
