// SPDX-License-Identifier: MIT
#pragma once

// Up to sixteen rays that go on past what is not shown: the backs of surfaces and what is buried.

#include <bit>
#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

namespace radiosity {

// Calls meet(i, hit, ray, passed) for what ray i meets next, after it has passed as many surfaces: the point from which the ray goes on, in
// the same direction, or nothing when it ends there.
template <class Meet>
void pass_through(const raycast::Scene& scene, const raycast::Segments16& from, const Meet& meet) {
  constexpr int most = 10'000;  // surfaces passed: only backs and buried ones are, so this ends what rounding might not
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
