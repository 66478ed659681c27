// SPDX-License-Identifier: MIT
#pragma once

// A lamp for a closed room in which nothing shines.

#include <memory>

#include <raycast/box.hpp>
#include <raycast/object.hpp>

#include <radiosity/scene/scene.hpp>

namespace apps {

// A square close under the ceiling (z up) of the room within these bounds. It looks down, where most of the air is around and below it.
// Null when no place was found.
[[nodiscard]] std::shared_ptr<const raycast::Object> ceiling_lamp(const radiosity::Scene& scene, const raycast::Box& room);

}  // namespace apps
