// SPDX-License-Identifier: MIT
#pragma once

// Traces up to sixteen rays through surfaces that are not shown: back faces and buried parts.

#include <bit>
#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

namespace radiosity {

// Calls meet(i, hit, ray, passed) for each hit of ray i; `passed`: number of hits before. meet() returns the point from which the ray
// continues in the same direction, or nothing if it ends there.
template <class Meet>
void pass_through(const raycast::Scene& scene, const raycast::Segments16& from, const Meet& meet) {
  constexpr int most = 10'000;  // limit of the hits passed: only backs and buried parts are, but rounding might repeat one endlessly
  raycast::Segments16 rays = from;
  for (int passed = 0; passed < most && rays.lanes != 0; ++passed) {
    const raycast::Hits16 hits = scene.closest16(rays);
    rays.lanes &= hits.met;
    for (std::uint32_t rest = rays.lanes; rest != 0; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      const raycast::Hit& hit = hits.hit[i];
      const raycast::Segment ray = rays.at(i);
      if (const std::optional<glm::dvec3> on = meet(i, hit, ray, passed)) {
        rays.set(i, {*on, ray.direction}, hit.object, raycast::no_object, hit.sheet);
      } else {
        rays.lanes &= ~(1u << i);
      }
    }
  }
}

}  // namespace radiosity
