// SPDX-License-Identifier: MIT
#pragma once

// Bundles of sixteen segments, as between two patches or through a pixel; the input of Scene::occluded16 and closest16.

#include <cstdint>
#include <functional>

#include <raycast/ray.hpp>

namespace raycast {

// The sheet of an end is not known.
inline constexpr std::uint32_t unknown_sheet = 0xffffffff;

// Sixteen segments in world coordinates, filled in by the caller. Lanes that are not set are ignored. Giving the sheets of the ends saves
// time, because what a segment does at an end on a flat sheet is then known without double precision. They change no answer, except for a
// segment that runs into its owner through a reentrant edge on which its end lies.
struct alignas(64) Segments16 {
  double ox[16] = {}, oy[16] = {}, oz[16] = {}, dx[16] = {}, dy[16] = {}, dz[16] = {};
  std::uint32_t source[16] = {}, target[16] = {};              // owners of the ends
  std::uint32_t source_sheet[16] = {}, target_sheet[16] = {};  // sheets of the owners, or unknown_sheet
  std::uint32_t lanes = 0;                                     // one bit for each lane that is set

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
  bool front;  // is the air side hit? false: the back of a polygon or of an open mesh
};

// The first hits of sixteen rays. A lane without a hit has no bit in `met`.
struct Hits16 {
  Hit hit[16];
  std::uint32_t met = 0;
};

// Another ray caster, used instead of a Scene's own search (Scene::ask) and called from many threads at once. The rays carry the owners
// and sheets of their ends; scene.hpp defines what stops a ray that begins or ends on a surface.
struct OtherCaster {
  // Returns the lanes whose segment is occluded, t in (0, 1).
  std::function<std::uint32_t(const Segments16&)> occluded16;
  // Sets the first hits at t > 0. Returns the lanes for which it cannot decide; the scene searches for these itself.
  std::function<std::uint32_t(const Segments16&, Hits16&)> closest16;
};

}  // namespace raycast
