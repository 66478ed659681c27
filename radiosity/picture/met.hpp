// SPDX-License-Identifier: MIT
#pragma once

// Converts a hit on a mesh that stands in for a slow object (direct_light.hpp) to the place on the true object.

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>

namespace radiosity {

// `objects`: the true objects; `hit`: of `ray` with direct.objects().
[[nodiscard]] raycast::ScenePoint met(const raycast::Scene& objects, const DirectLight& direct, const raycast::Hit& hit,
                                      const raycast::Segment& ray);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/met.cpp>
#endif
