// SPDX-License-Identifier: MIT
#pragma once

// Warnings about doubtful properties of a valid scene. It is solved by fixed rules all the same, and these sentences say where the result
// may not be what was meant: two objects at the same place (the later one is seen, raycast/scene.hpp), objects that are hidden
// altogether, open shells (their backs are black), coordinates so far from the origin that rounding exceeds the distance at which
// surfaces are told apart.

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

// `surfaces` must be those before refinement, which adds edges.
[[nodiscard]] std::vector<std::string> warnings(const Scene& scene, const Frame& frame, const std::vector<Surface>& surfaces);

// Objects without any exposed area, including those named by a warning about duplicates.
[[nodiscard]] std::vector<std::string> warnings_of_buried(const Scene& scene, const Hierarchy& hierarchy, const Exposure& exposure);

// A sentence with advice if some surfaces can reflect but less than a millionth of the emitted light was reflected. Empty when more was
// reflected, or nothing emits.
[[nodiscard]] std::string warning_of_lost_light(const DiscreteScene& scene, const std::vector<Color>& radiosity);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/warnings.cpp>
#endif
