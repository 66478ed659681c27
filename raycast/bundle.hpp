// SPDX-License-Identifier: MIT
#pragma once

// Sixteen segments, as they run between two patches or through a pixel: what Scene::occluded16 and closest16 are asked.

#include <cstdint>
#include <functional>

#include <glm/vec3.hpp>

#include <raycast/ray.hpp>

namespace raycast {

// Of an end of which it is not known on which sheet of its owner it lies.
inline constexpr std::uint32_t unknown_sheet = 0xffffffff;

// Sixteen segments in the world, as the caller fills them in. Lanes that are not set take no part. Sheets of the ends save time: what a
// segment does at an end that lies on a flat sheet is known without double precision. They change no answer except for a segment that runs
// into its owner through a reentrant edge on which its end lies.
struct alignas(64) Segments16 {
  double ox[16] = {}, oy[16] = {}, oz[16] = {}, dx[16] = {}, dy[16] = {}, dz[16] = {};
  std::uint32_t source[16] = {}, target[16] = {};              // owners of the ends
  std::uint32_t source_sheet[16] = {}, target_sheet[16] = {};  // where these are objects: sheets of theirs, or unknown_sheet
  std::uint32_t lanes = 0;                                     // one bit per lane that is set

  void set(unsigned lane, const Segment& s, std::uint32_t source_owner, std::uint32_t target_owner, std::uint32_t on_source = unknown_sheet,
           std::uint32_t on_target = unknown_sheet) {
    ox[lane] = s.origin.x, oy[lane] = s.origin.y, oz[lane] = s.origin.z;
    dx[lane] = s.direction.x, dy[lane] = s.direction.y, dz[lane] = s.direction.z;
    source[lane] = source_owner, target[lane] = target_owner;
    source_sheet[lane] = on_source, target_sheet[lane] = on_target;
    lanes |= 1u << lane;
  }
  [[nodiscard]] Segment at(unsigned lane) const { return {{ox[lane], oy[lane], oz[lane]}, {dx[lane], dy[lane], dz[lane]}}; }
};

struct Hit {
  double t;
  std::uint32_t object, sheet;
  bool front;  // the ray meets the air side; false: the back of a polygon or of an open mesh
};

// What sixteen rays meet first. A lane that meets nothing has no bit in `met`.
struct Hits16 {
  Hit hit[16];
  std::uint32_t met = 0;
};

// Another ray caster, asked in place of a Scene's own search (Scene::ask), from many threads at once. The rays carry the owners and sheets
// of their ends; scene.hpp tells what stops a ray that begins or ends on a surface.
struct OtherCaster {
  // The lanes whose segment is occluded, t in (0, 1).
  std::function<std::uint32_t(const Segments16&)> occluded16;
  // What the rays meet first at t > 0. Returns the lanes that it cannot tell: of these the scene asks itself.
  std::function<std::uint32_t(const Segments16&, Hits16&)> closest16;
};

}  // namespace raycast
