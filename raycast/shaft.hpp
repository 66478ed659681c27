// SPDX-License-Identifier: MIT
#pragma once

// Occluder lists: the shapes that can stand between two patches. A list is made once for a pair, and only filtered for pairs of their
// children.
//
// Two proofs save rays. If a list is empty, no segment between the patches is occluded. If one convex occluder contains a section of the
// hull of both, every segment is. Both hold for all pairs of descendants.
//
// `bulge`: how far the points of the patch and of all its descendants may lie outside the hull of its contour. It is 0 on a flat sheet,
// and the sagitta where refined vertices move out to a curved surface. A parent's list is valid for children whose hulls, widened by
// their bulges, lie within those of the parent. Lists with more than 64 entries are not kept and count as unknown, for descendants too
// (their segments search the whole scene, which is correct and usually faster than gathering again). Once descendants have become much
// smaller, occluders() makes a new list. Far objects (far_objects.hpp) are in no list; if one may stand between, the list is unknown.
//
// Convex owners: a segment whose end lies on or in a convex object that owns it is never blocked by that object. This is proven for the
// contour, and holds for descendants because their vertices lie on the surface, too, and their points in the hull of these.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>

namespace raycast {

class Scene;

struct PatchShape {
  std::span<const glm::dvec3> contour;  // at least 3 points, planar up to the bulge
  std::uint32_t owner = no_object;
  double bulge = 0.0;                   // a length in world coordinates
  std::uint32_t sheet = unknown_sheet;  // sheet of the owner, as in Segments16
};

class OccluderList {
 public:
  static constexpr std::uint32_t capacity = 64;

  OccluderList() = default;  // unknown
  // A list that was stored elsewhere: at most `capacity` shapes, and whether no room is in the way.
  OccluderList(std::span<const std::uint32_t> shapes, bool rooms_clear)
      : state_(State::listed), rooms_clear_(rooms_clear), count_(static_cast<std::uint32_t>(shapes.size())) {
    std::copy(shapes.begin(), shapes.end(), shapes_.begin());
  }
  static OccluderList nothing() { return {{}, true}; }

  [[nodiscard]] bool known() const { return state_ != State::unknown; }  // false: more than `capacity` shapes; the whole scene is searched
  [[nodiscard]] bool clear() const { return state_ == State::listed && count_ == 0 && rooms_clear_; }  // proven: nothing is occluded
  [[nodiscard]] bool blocked() const { return state_ == State::blocked; }                              // proven: everything is occluded
  [[nodiscard]] bool rooms_clear() const { return rooms_clear_; }                                      // no room is in the way
  [[nodiscard]] std::span<const std::uint32_t> shapes() const { return {shapes_.data(), state_ == State::listed ? count_ : 0}; }

 private:
  friend class Scene;
  enum class State : std::uint8_t { unknown, listed, blocked };
  State state_ = State::unknown;
  bool rooms_clear_ = false;
  std::uint32_t count_ = 0;
  std::array<std::uint32_t, capacity> shapes_;
};

}  // namespace raycast
