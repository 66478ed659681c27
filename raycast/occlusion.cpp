// SPDX-License-Identifier: MIT

// Occlusion of one segment and of sixteen: the fast searches of kernels.hpp, followed by the double-precision law of scene.hpp.
//
// Segments may lie anywhere: one that extends beyond the compiled scene is clipped to it, and may meet far objects. Rooms come last: if
// both ends lie in or on a convex room, it does not block.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/kernels.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

namespace detail {

// Clips a segment that extends beyond the compiled scene to `lane_cube` around its middle and stores it in lane `lane` of `rays`. Returns
// false if nothing is left. Requires ends within `farthest_cut`.
HALFLIGHT_INLINE bool clip(const Compiled& scene, const Segment& segment, unsigned lane, Rays16& rays) {
  const glm::dvec3 o = scene.local(segment.origin), d = segment.direction * scene.scale;
  double t0 = 0.0, t1 = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double a = (-lane_cube - o[k]) / d[k], b = (lane_cube - o[k]) / d[k];
    if (d[k] == 0.0) {
      if (std::abs(o[k]) > lane_cube) { return false; }
      continue;
    }
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  if (!(t0 < t1)) { return false; }
  const glm::dvec3 from = o + t0 * d, to = o + t1 * d;
  float* const rows[9] = {rays.ox, rays.oy, rays.oz, rays.tx, rays.ty, rays.tz, rays.dx, rays.dy, rays.dz};
  for (int k = 0; k < 3; ++k) {
    rows[k][lane] = static_cast<float>(from[k]);
    rows[k + 3][lane] = static_cast<float>(to[k]);
    rows[k + 6][lane] = static_cast<float>(to[k] - from[k]);
  }
  return true;
}

}  // namespace detail

// Evaluates the law for one object, or one face of an open surface, in some lanes.
struct Scene::Exact {
  const Scene& scene;
  const Segments16& segments;

  std::uint32_t operator()(std::uint32_t object, std::uint32_t face, std::uint32_t lanes) const {
    std::uint32_t result = 0;
    for (std::uint32_t rest = lanes; rest; rest &= rest - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(rest));
      const Segment s = segments.at(lane);
      const End source = scene.end_at(segments.source[lane]), target = scene.end_at(segments.target[lane]);
      if (face == Pending::whole ? scene.blocks(Line(s), source, target, object) : scene.blocks_by_face(s, source, target, object, face)) {
        result |= 1u << lane;
      }
    }
    return result;
  }
  [[nodiscard]] bool touches(unsigned lane, bool source, std::uint32_t object, std::uint32_t sheet) const {
    const Segment s = segments.at(lane);
    return scene.touches(source ? s.origin : s.at(1.0), scene.end_at(source ? segments.source[lane] : segments.target[lane]), object,
                         sheet);
  }
  [[nodiscard]] bool crosses(unsigned lane, std::uint32_t object, std::uint32_t face) const {
    return scene.objects_[object].winding(segments.at(lane), face) != 0;
  }
};

// As above for one segment.
struct Scene::ExactOne {
  const Scene& scene;
  const Segment& segment;
  End source, target;

  std::uint32_t operator()(std::uint32_t object, std::uint32_t face, std::uint32_t) const {
    return face == Pending::whole ? scene.blocks(Line(segment), source, target, object)
                                  : scene.blocks_by_face(segment, source, target, object, face);
  }
  [[nodiscard]] bool touches(unsigned, bool at_source, std::uint32_t object, std::uint32_t sheet) const {
    return scene.touches(at_source ? segment.origin : segment.at(1.0), at_source ? source : target, object, sheet);
  }
  [[nodiscard]] bool crosses(unsigned, std::uint32_t object, std::uint32_t face) const {
    return scene.objects_[object].winding(segment, face) != 0;
  }
};

// Of lanes in which no face of a room blocks, returns those that may lie in the solid around the room. As with every solid with stored
// faces, an end on it decides, or one point in the air.
HALFLIGHT_INLINE std::uint32_t Scene::may_be_around(const Guard& room, const Rays16& rays, std::uint32_t lanes) const {
  for (std::uint32_t rest = lanes; rest; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    if (rays.source[i] == room.object || rays.target[i] == room.object) { lanes &= ~(1u << i); }
  }
  return HALFLIGHT_DISPATCH(isa_, not_in_air(room.air, rays, lanes));
}

// Which of `lanes` are blocked by rooms? `near`: the lanes whose entry in `rays` is the segment itself, not clipped.
HALFLIGHT_INLINE std::uint32_t Scene::blocked_by_rooms(const Segments16& segments, const Rays16& rays, std::uint32_t near,
                                                       std::uint32_t lanes) const {
  const Exact exact{*this, segments};
  std::uint32_t blocked = 0;
  for (const Guard& room : compiled_.face_rooms) {
    const std::uint32_t open = lanes & ~blocked, ask = (open & ~near) | may_be_around(room, rays, open & near);
    if (ask) { blocked |= exact(room.object, Pending::whole, ask); }
  }
  for (std::size_t r = 0; r < compiled_.rooms.size(); ++r) {
    const std::uint32_t room = compiled_.rooms[r], body = compiled_.room_bodies[r];
    std::uint32_t ask = lanes & ~blocked, from = 0, to = 0;
    if (objects_[room].convex()) {
      for (unsigned i = 0; i < 16; ++i) {
        from |= static_cast<std::uint32_t>(segments.source[i] == room) << i;
        to |= static_cast<std::uint32_t>(segments.target[i] == room) << i;
      }
      ask &= ~(from & to);
      if (body != no_shape && ask) {
        const Body& b = compiled_.bodies[body];
        const auto* planes = compiled_.planes.data();
        const float margin = compiled_.margin;
        const std::uint32_t o = HALFLIGHT_DISPATCH(isa_, inside(b, planes, rays.ox, rays.oy, rays.oz, margin));
        const std::uint32_t t = HALFLIGHT_DISPATCH(isa_, inside(b, planes, rays.tx, rays.ty, rays.tz, margin));
        ask &= ~(near & (from | o) & (to | t));
      }
    }
    for (std::uint32_t rest = objects_[room].convex() ? ask : 0; rest; rest &= rest - 1) {  // ends on or near a wall
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      const Segment s = segments.at(i);
      if (((from >> i & 1u) || in_room(r, s.origin)) && ((to >> i & 1u) || in_room(r, s.at(1.0)))) { ask &= ~(1u << i); }
    }
    if (ask) { blocked |= exact(room, Pending::whole, ask); }
  }
  return blocked;
}

HALFLIGHT_INLINE std::uint32_t Scene::occluded16(const Segments16& segments, const std::uint32_t* list, std::uint32_t count,
                                                 bool rooms_clear, std::uint32_t& hint) const {
  if (other_.occluded16) { return other_.occluded16(segments) & segments.lanes; }
  Rays16 rays;
  unsigned lines = 0;
  const unsigned near = HALFLIGHT_DISPATCH(isa_, convert(compiled_, segments, rays, lines));
  const Exact exact{*this, segments};
  std::uint32_t blocked = 0, bounded = near;
  if (near != lines) {
    for (std::uint32_t rest = lines & ~near; rest; rest &= rest - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(rest));
      const Segment s = segments.at(lane);
      const Box ends{compiled_.local(s.origin), compiled_.local(s.at(1.0))};
      if (!(std::max(Box{ends.lo, ends.lo}.magnitude(), Box{ends.hi, ends.hi}.magnitude()) < farthest_cut)) {
        for (std::uint32_t i = 0; i < objects_.size(); ++i) {
          if (exact(i, Pending::whole, 1u << lane)) {
            blocked |= 1u << lane;
            break;
          }
        }
      } else if (detail::clip(compiled_, s, lane, rays)) {
        bounded |= 1u << lane;
      }
    }
    HALFLIGHT_DISPATCH(isa_, finish(rays));
  }
  if (bounded) { blocked |= HALFLIGHT_DISPATCH(isa_, blocked(compiled_, rays, bounded, list, count, hint, exact)); }
  for (std::size_t i = 0; i < far_.size() && (lines & ~near & ~blocked) != 0; ++i) {
    blocked |= exact(far_[i], Pending::whole, lines & ~near & ~blocked);
  }
  if (!rooms_clear && (lines & ~blocked)) { blocked |= blocked_by_rooms(segments, rays, near, lines & ~blocked); }
  return blocked;
}

HALFLIGHT_INLINE std::uint32_t Scene::occluded16(const Segments16& segments, std::uint32_t& hint) const {
  return occluded16(segments, nullptr, 0, false, hint);
}

HALFLIGHT_INLINE bool Scene::occluded(const Segment& segment, std::uint32_t source_owner, std::uint32_t target_owner) const {
  if (!has_line(segment)) { return false; }
  Rays16 rays;
  if (other_.occluded16 || !HALFLIGHT_DISPATCH(isa_, convert_one(compiled_, segment, source_owner, unknown_sheet, target_owner, rays))) {
    Segments16 segments;
    segments.set(0, segment, source_owner, target_owner);
    return occluded16(segments) != 0;
  }
  const ExactOne exact{*this, segment, end_at(source_owner), end_at(target_owner)};
  if (HALFLIGHT_DISPATCH(isa_, blocked_one(compiled_, rays, exact))) { return true; }
  for (const Guard& room : compiled_.face_rooms) {
    if (may_be_around(room, rays, 1u) != 0 && exact(room.object, Pending::whole, 1u) != 0) { return true; }
  }
  for (std::size_t r = 0; r < compiled_.rooms.size(); ++r) {
    const std::uint32_t room = compiled_.rooms[r];
    const bool clear = objects_[room].convex() && (source_owner == room || in_room(r, segment.origin)) &&
                       (target_owner == room || in_room(r, segment.at(1.0)));
    if (!clear && exact(room, Pending::whole, 1u) != 0) { return true; }
  }
  return false;
}

}  // namespace raycast
