// SPDX-License-Identifier: MIT
#pragma once

// What a sound scene makes doubtful. It is solved all the same, by rules that are fixed, and the run says where they may not be what was
// meant: two objects at one place (the later one is seen, raycast/scene.hpp), objects of which nothing shows, open shells (their backs are
// black), coordinates that are known no better than surfaces must be told apart.

#include <cstdint>
#include <string>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

// `surfaces` before refinement: afterwards they have more edges.
[[nodiscard]] std::vector<std::string> warnings(const Scene& scene, const Frame& frame, const std::vector<Surface>& surfaces);

// Objects of which nothing is exposed, those that a warning of duplicates names included.
[[nodiscard]] std::vector<std::string> warnings_of_buried(const Scene& scene, const Hierarchy& hierarchy, const Exposure& exposure);

// A sentence that says what to look for when surfaces reflected less than a millionth of the light of the lamps, though some surfaces
// reflect. Empty when more was reflected, or nothing shines.
[[nodiscard]] std::string warning_of_lost_light(const DiscreteScene& scene, const std::vector<Color>& radiosity);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/warnings.cpp>
#endif
