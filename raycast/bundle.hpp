// SPDX-License-Identifier: MIT
#pragma once

// Sixteen segments, as they run between two patches: what Scene::occluded16 is asked.

#include "ray.hpp"

#include <cstdint>

namespace raycast {

// Sixteen segments in the world, as the caller fills them in. Lanes that are not set take no part.
struct alignas(64) Segments16 {
  double ox[16] = {}, oy[16] = {}, oz[16] = {}, dx[16] = {}, dy[16] = {}, dz[16] = {};
  std::uint32_t source[16] = {}, target[16] = {};  // owners of the ends
  std::uint32_t lanes = 0;                         // one bit per lane that is set

  void set(unsigned lane, const Segment& s, std::uint32_t source_owner, std::uint32_t target_owner) {
    ox[lane] = s.origin.x, oy[lane] = s.origin.y, oz[lane] = s.origin.z;
    dx[lane] = s.direction.x, dy[lane] = s.direction.y, dz[lane] = s.direction.z;
    source[lane] = source_owner, target[lane] = target_owner;
    lanes |= 1u << lane;
  }
  [[nodiscard]] Segment at(unsigned lane) const { return {{ox[lane], oy[lane], oz[lane]}, {dx[lane], dy[lane], dz[lane]}}; }
};

}  // namespace raycast
