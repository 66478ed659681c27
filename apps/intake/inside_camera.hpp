// SPDX-License-Identifier: MIT
#pragma once

// A camera for a model without one whose light cannot be seen from outside: a house with lamps in its rooms.

#include <optional>

#include <radiosity/scene/scene.hpp>

#include "apps/scene_file.hpp"

namespace apps {

// From the far end of the room of the first lamp, across it. Nothing when the automatic camera sees something that a lamp shines on, or
// when there is no place.
[[nodiscard]] std::optional<Camera> inside_camera(const radiosity::Scene& scene);

}  // namespace apps
