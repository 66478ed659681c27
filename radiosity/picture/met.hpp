// SPDX-License-Identifier: MIT
#pragma once

// The place on the true objects of what a ray has met among the meshes that stand in for slow ones (direct_light.hpp).

#include <cstdint>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>

namespace radiosity {

struct Met {
  raycast::SurfacePoint point;
  std::uint32_t object = 0, sheet = 0;
};

// `objects`: the true ones; `hit`: of a ray among direct.objects().
[[nodiscard]] Met met(const raycast::Scene& objects, const DirectLight& direct, const raycast::Hit& hit, const raycast::Segment& ray);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/met.cpp>
#endif
