// SPDX-License-Identifier: MIT

// Makes the occluder lists of shaft.hpp, from the whole scene or from the list of an ancestor.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/kernels.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

namespace detail {

// Four points whose hull contains the contour; the contour itself if it has no more.
HALFLIGHT_INLINE std::array<glm::dvec3, 4> four_corners(std::span<const glm::dvec3> contour) {
  if (contour.size() <= 4) { return {contour[0], contour[1], contour[2], contour[std::min<std::size_t>(3, contour.size() - 1)]}; }
  const glm::dvec3 n = brep::normal(contour), u = glm::normalize(contour[1] - contour[0]), v = glm::cross(n, u);
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  for (const glm::dvec3& p : contour) {
    const double x = glm::dot(p - contour[0], u), y = glm::dot(p - contour[0], v);
    u0 = std::min(u0, x), u1 = std::max(u1, x), v0 = std::min(v0, y), v1 = std::max(v1, y);
  }
  const auto at = [&](double x, double y) { return contour[0] + x * u + y * v; };
  return {at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v1)};
}

// Cuts the 16 segments of `c`, from the corners `near` to the corners `far`, at a plane before the latter that has the cube
// [-half, half]^3 on its near side: within the cube, their convex hull stays the same. Returns false if one does not cross the plane, or
// reaches beyond `most` even then. `swapped`: `far` is the first patch.
HALFLIGHT_INLINE bool cut_far_ends(const std::array<glm::dvec3, 4>& near, const std::array<glm::dvec3, 4>& far, bool swapped, double half,
                                   double most, Corners16& c) {
  glm::dvec3 way{0.0};
  for (std::size_t i = 0; i < 4; ++i) { way += far[i] - near[i]; }
  const glm::dvec3 n = glm::normalize(way);
  const double plane = half * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  float* const ends[3] = {swapped ? c.rays.ox : c.rays.tx, swapped ? c.rays.oy : c.rays.ty, swapped ? c.rays.oz : c.rays.tz};
  for (std::size_t lane = 0; lane < 16; ++lane) {
    const glm::dvec3 &from = near[swapped ? lane % 4 : lane / 4], &to = far[swapped ? lane / 4 : lane % 4];
    const double a = glm::dot(n, from), b = glm::dot(n, to);
    const glm::dvec3 cut = from + (plane - a) / (b - a) * (to - from);
    if (!(a <= plane && plane < b && Box{cut, cut}.magnitude() < most)) { return false; }
    for (int k = 0; k < 3; ++k) { ends[k][lane] = static_cast<float>(cut[k]); }
  }
  return true;
}

// The corners of two patches in the form of the kernels. If one patch is far away, and all else within [-half, half]^3, the segments to
// it are cut. Nothing if they extend beyond the compiled scene even so.
HALFLIGHT_INLINE std::optional<Corners16> corners_for_kernels(const Compiled& compiled, Isa isa, const PatchShape& a, const PatchShape& b,
                                                              std::array<glm::dvec3, 4> p, std::array<glm::dvec3, 4> q, double half) {
  Corners16 c;
  float pf[3][4], qf[3][4];
  double reach_p = 0.0, reach_q = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    p[i] = compiled.local(p[i]), q[i] = compiled.local(q[i]);
    for (int k = 0; k < 3; ++k) {
      pf[k][i] = static_cast<float>(p[i][k]), qf[k][i] = static_cast<float>(q[i][k]);
      reach_p = std::max(reach_p, std::abs(p[i][k])), reach_q = std::max(reach_q, std::abs(q[i][k]));
    }
  }
  const double bulge = std::max(a.bulge, b.bulge), most = lane_reach - bulge * compiled.scale;
  c.bulge = bulge > 0.0 ? static_cast<float>(bulge * compiled.scale) * length_up + unit_roundoff_single : 0.0f;
  c.source = a.owner, c.target = b.owner;
  c.source_sheet = a.sheet, c.target_sheet = b.sheet;
  HALFLIGHT_DISPATCH(isa, spread_corners(pf, qf, c));
  if (reach_p < most && reach_q < most) { return c; }
  const bool cut = reach_p < most   ? cut_far_ends(p, q, false, half, most, c)
                   : reach_q < most ? cut_far_ends(q, p, true, half, most, c)
                                    : false;
  if (!cut) { return std::nullopt; }
  HALFLIGHT_DISPATCH(isa, join_corners(c));
  return c;
}

}  // namespace detail

HALFLIGHT_INLINE OccluderList Scene::occluders(const PatchShape& a, const PatchShape& b) const { return list_of(nullptr, a, b); }
HALFLIGHT_INLINE OccluderList Scene::filter(const OccluderList& parent, const PatchShape& a, const PatchShape& b) const {
  if (parent.blocked() || parent.clear() || !parent.known()) { return parent; }
  return list_of(&parent, a, b);
}

HALFLIGHT_INLINE OccluderList Scene::list_of(const OccluderList* parent, const PatchShape& a, const PatchShape& b) const {
  OccluderList list;
  const std::array<glm::dvec3, 4> p = detail::four_corners(a.contour), q = detail::four_corners(b.contour);
  std::optional<Corners16> corners = detail::corners_for_kernels(compiled_, isa_, a, b, p, q, far_.empty() ? 1.0 : 0.5);
  if (!corners || far_between(p, q, a, b)) { return list; }
  Corners16& c = *corners;
  const double bulge = std::max(a.bulge, b.bulge);
  const bool faces_alone =
      parent && parent->known() && std::all_of(parent->shapes().begin(), parent->shapes().end(), [](std::uint32_t shape) {
        return kind_of(shape) == Kind::triangle || kind_of(shape) == Kind::quad;
      });
  if (!faces_alone) {
    HALFLIGHT_DISPATCH(isa_, widen(c));  // faces are compared with the corners
  }

  // A polygon matters only if one corner lies behind its plane and another in front of it, by more than rounding: half the skin of
  // scene.hpp, because the points are accurate to a fraction of it.
  const auto on_both_sides = [&](const Record& polygon) {
    double low = infinity, high = -infinity;
    for (const auto& contour : {p, q}) {
      for (const glm::dvec3& x : contour) {
        const double height = glm::dot(polygon.normal, x - polygon.point);
        low = std::min(low, height), high = std::max(high, height);
      }
    }
    return !(low - bulge >= -0.5 * rounding_ || high + bulge <= 0.5 * rounding_);
  };
  // A crossing of an open surface is ignored up to a skin from an end (scene.hpp). So a face in whose plane one of the patches lies does
  // not matter: decals, things that stand on others, walls back to back.
  const auto lies_in = [&](const PatchShape& patch, const std::array<glm::dvec3, 4>& contour, std::uint32_t object, std::uint32_t sheet) {
    const End end = end_at(patch.owner);
    const Box near = objects_[object].bounds().grown(0.5 * skin(end, object));
    return patch.bulge == 0.0 && std::all_of(contour.begin(), contour.end(),
                                             [&](const glm::dvec3& x) { return near.contains(x) && touches(x, end, object, sheet); });
  };
  const auto matters = [&](std::uint32_t object, std::uint32_t sheet) {
    if (records_[object].corner_count) { return on_both_sides(records_[object]); }
    return !lies_in(a, p, object, sheet) && !lies_in(b, q, object, sheet);
  };
  std::array<std::optional<bool>, 2> skipped;  // cached, because a convex solid with stored faces is tested for each of them
  const auto skips = [&](std::uint32_t object) {
    if (!objects_[object].convex()) { return false; }
    std::optional<bool>& known = skipped[object == a.owner ? 0 : 1];
    if (!known) { known = a.owner == b.owner || within(object, object == a.owner ? a.contour : b.contour); }
    return *known;
  };
  const std::uint32_t count =
      parent ? HALFLIGHT_DISPATCH(isa_, narrow(compiled_, c, parent->shapes_.data(), parent->count_, list.shapes_.data(), matters, skips))
             : HALFLIGHT_DISPATCH(isa_, gather(compiled_, c, list.shapes_.data(), OccluderList::capacity, matters, skips));
  if (count == ~0u) {
    list.state_ = OccluderList::State::blocked;
  } else if (count <= OccluderList::capacity) {
    list.state_ = OccluderList::State::listed;
    list.count_ = count;
    drop_guards(list, c);
  }
  list.rooms_clear_ = (parent && parent->rooms_clear_) || rooms_clear(a, b, list, c);
  return list;
}

// May a far object, which no list contains, stand between the patches? All segments between them lie about the line between their middles.
HALFLIGHT_INLINE bool Scene::far_between(const std::array<glm::dvec3, 4>& p, const std::array<glm::dvec3, 4>& q, const PatchShape& a,
                                         const PatchShape& b) const {
  if (far_.empty()) { return false; }
  const auto middle = [](const std::array<glm::dvec3, 4>& x) { return 0.25 * (x[0] + x[1] + x[2] + x[3]); };
  const Segment axis = between(middle(p), middle(q));
  double about = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    about = std::max({about, glm::distance(p[i], axis.origin) + a.bulge, glm::distance(q[i], axis.at(1.0)) + b.bulge});
  }
  const SlabTest slabs(axis);
  return std::any_of(far_.begin(), far_.end(), [&](std::uint32_t i) {
    double entry = 0.0;
    const bool own = (i == a.owner || i == b.owner) && (records_[i].corner_count || objects_[i].convex());
    return !own && slabs(objects_[i].bounds().grown(about), 0.0, 1.0, entry);
  });
}

// If a solid has no face in the list, no segment crosses its surface. So all segments are inside or all are outside, and one point in the
// air decides.
HALFLIGHT_INLINE void Scene::drop_guards(OccluderList& list, const Corners16& corners) const {
  const std::array<std::uint32_t, OccluderList::capacity> shapes = list.shapes_;
  const auto* const end = shapes.begin() + list.count_;
  const auto matters = [&](std::uint32_t guard) {
    const std::uint32_t object = compiled_.object_of(guard);
    const auto face = [&](std::uint32_t shape) { return shape != guard && compiled_.object_of(shape) == object; };
    return std::any_of(shapes.begin(), end, face) ||
           HALFLIGHT_DISPATCH(isa_, not_in_air(compiled_.guards[index_of(guard)].air, corners.rays, 0xffffu)) == 0xffffu;
  };
  list.count_ = 0;
  for (const auto* shape = shapes.begin(); shape != end; ++shape) {
    if (kind_of(*shape) != Kind::guard || matters(*shape)) { list.shapes_[list.count_++] = *shape; }
  }
}

// Are all points on or in the convex object, within rounding? Then so is their hull.
HALFLIGHT_INLINE bool Scene::within(std::uint32_t object, std::span<const glm::dvec3> points) const {
  const PlacedObject& body = objects_[object];
  for (const glm::dvec3& p : points) {
    const Segment inwards = between(p, body.bounds().centre());
    if (!has_line(inwards)) { continue; }
    Spans spans;
    body.spans(inwards, spans);
    if (spans.size() != 1 || !(spans[0].in.t * glm::length(inwards.direction) <= 0.25 * rounding_) || !(spans[0].out.t >= 0.0)) {
      return false;
    }
  }
  return true;
}

// A room with stored faces blocks nothing between patches if none of its faces may, and a point in the air or an owner shows that they
// are inside. A convex room blocks nothing between patches in it or on it.
HALFLIGHT_INLINE bool Scene::rooms_clear(const PatchShape& a, const PatchShape& b, const OccluderList& list,
                                         const Corners16& corners) const {
  for (const Guard& room : compiled_.face_rooms) {
    const auto of_room = [&](std::uint32_t shape) { return compiled_.object_of(shape) == room.object; };
    const std::span<const std::uint32_t> shapes = list.shapes();
    if (!list.known() || std::any_of(shapes.begin(), shapes.end(), of_room)) { return false; }
    const bool owns = a.owner == room.object || b.owner == room.object;
    if (!owns && HALFLIGHT_DISPATCH(isa_, not_in_air(room.air, corners.rays, 0xffffu)) == 0xffffu) { return false; }
  }
  for (std::size_t r = 0; r < compiled_.rooms.size(); ++r) {
    const std::uint32_t room = compiled_.rooms[r];
    if (!objects_[room].convex()) { return false; }
    if (a.owner == room && b.owner == room) { continue; }
    for (const PatchShape* patch : {&a, &b}) {
      if (patch->owner != room &&
          !std::all_of(patch->contour.begin(), patch->contour.end(), [&](const glm::dvec3& p) { return in_room(r, p, patch->bulge); })) {
        return false;
      }
    }
  }
  return true;
}

HALFLIGHT_INLINE std::uint32_t Scene::occluded16(const Segments16& segments, const OccluderList& list, std::uint32_t& hint) const {
  if (list.clear()) { return 0; }
  if (list.blocked()) {
    std::uint32_t lines = 0;
    for (unsigned i = 0; i < 16; ++i) {
      if (segments.lanes >> i & 1u) { lines |= static_cast<std::uint32_t>(has_line(segments.at(i))) << i; }
    }
    return lines;
  }
  return occluded16(segments, list.known() ? list.shapes_.data() : nullptr, list.count_, list.rooms_clear_, hint);
}

}  // namespace raycast
