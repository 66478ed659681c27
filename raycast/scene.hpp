// SPDX-License-Identifier: MIT
#pragma once

// All objects of a scene, compiled for rays (compiled.hpp), and the law of occlusion in double precision.
//
// The ends of a visibility segment lie on surfaces, up to rounding, or on chord patches inside convex ones (paper 4.3). Instead of an
// epsilon along the ray, spans decide (notes/raycaster.md R3):
//   - of an end's owner, the span that contains the end is dropped: a ray that leaves a solid is never stopped by its own skin, while a
//     concave solid still shadows itself further on. A polygon that is an owner is left out, and so is a convex object that owns both ends;
//   - of every other object, a span is dropped when the end only touches it: it is no deeper behind the crossed surface than a skin; or
//     when it ends within the owner's own dropped span (up to the skin): a chord point inside its owner stands for the owner's surface, and
//     what is sunk into the owner, or fills the same place, is not in front of that.
// A depth is measured across the surface, |t_crossing - t_end| |n.d|, so it does not depend on the angle of the ray. For a convex solid
// it bounds how deep any point of the dropped part lies inside.
//
// Skins. `rounding` = 64 u M, M the largest coordinate of the scene: an interpolated point is off its surface by at most 8 u M, an
// affine map adds 12 u M, a plane distance 12 u M, a crossing of sphere or cylinder 32 u M (notes/raycaster.md 3). To it comes what
// the two surfaces are known to be non-planar by, and, between two objects, 1e-9 of the smaller one's diameter: so closely a lamp
// must fit the ceiling to count as lying on it. The same skin decides in covered(), so what is coincident there is so here too.
//
// This law, object by object, is blocks(). The fast searches answer from single precision where its error bound allows, and ask
// blocks() elsewhere: their answers are those of asking blocks() about every object, bit for bit, for any instruction set.
//
// All queries are const, thread-safe, and use no heap (a line that crosses a mesh more than eight times excepted).

#include "compile.hpp"
#include "planar.hpp"
#include "transform.hpp"
#include "traverse.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace raycast {

inline constexpr std::uint32_t no_object = 0xffffffff;

class OccluderList;
struct PatchShape;

struct Hit {
  double t;
  std::uint32_t object, sheet;
  bool front;  // the ray meets the air side; false: the back of a polygon or of an open mesh
};

class Scene {
 public:
  // Every instruction set gives the same answers; one that the machine does not have must not be named.
  explicit Scene(std::vector<PlacedObject> objects, Isa isa = best_isa());

  [[nodiscard]] const PlacedObject& object(std::uint32_t i) const { return objects_[i]; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(objects_.size()); }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  [[nodiscard]] double diameter() const { return bounds_.diameter(); }
  [[nodiscard]] std::size_t bytes() const {  // of the compiled scene, without the objects themselves
    return objects_.capacity() * sizeof(PlacedObject) + records_.capacity() * sizeof(Record) + corners_.capacity() * sizeof(glm::dvec3) +
           walls_.capacity() * sizeof(Plane) + compiled_.bytes();
  }

  // Does anything stand between the two ends, t in (0, 1)? The owners are the objects on which the ends lie. Symmetric: exchanging ends
  // and owners gives the same answer (up to the rounding of grazing rays). A segment of no length is never occluded.
  [[nodiscard]] bool occluded(const Segment& segment, std::uint32_t source_owner = no_object, std::uint32_t target_owner = no_object) const;

  // The lanes whose segment is occluded: bit for bit the answers of occluded() for each. `hint` remembers what blocked last, a shape
  // that is looked at first: keep one per pair of patches, or per patch.
  [[nodiscard]] std::uint32_t occluded16(const Segments16& segments, std::uint32_t& hint) const;
  [[nodiscard]] std::uint32_t occluded16(const Segments16& segments) const {
    std::uint32_t hint = no_shape;
    return occluded16(segments, hint);
  }

  // What may occlude segments between two patches (shaft.hpp), from the whole scene or from the list of a pair of their ancestors.
  [[nodiscard]] OccluderList occluders(const PatchShape& a, const PatchShape& b) const;
  [[nodiscard]] OccluderList filter(const OccluderList& parent, const PatchShape& a, const PatchShape& b) const;
  // As above, for segments between the patches of the list: the same answers.
  [[nodiscard]] std::uint32_t occluded16(const Segments16& segments, const OccluderList& list, std::uint32_t& hint) const;

  // The law for one object: what occluded() is defined by. In double precision, without any search.
  [[nodiscard]] bool occluded_by(std::uint32_t object, const Segment& segment, std::uint32_t source_owner = no_object,
                                 std::uint32_t target_owner = no_object) const {
    return has_line(segment) && blocks(Line(segment), end_at(source_owner), end_at(target_owner), object);
  }

  // The first surface met at t > 0, without upper limit: where a span of any object begins. Of surfaces that coincide the one that
  // covers is met: the later object when they face the same way, the front when they stand back to back.
  [[nodiscard]] std::optional<Hit> closest(const Segment& ray, std::uint32_t source_owner = no_object) const;

  // Is the point p with air normal n (unit) of an object's surface buried: does another object fill the air just in front of p (p is
  // inside it, or it stands on p), or does a later object's surface coincide and face the same way? Surfaces without thickness
  // that stand back to back (a sheet with two sides) do not bury each other.
  [[nodiscard]] bool covered(const glm::dvec3& p, const glm::dvec3& n, std::uint32_t owner) const;

 private:
  struct Record {                                      // what a query needs to know of an object
    glm::dvec3 normal{0.0}, point{0.0};                // of a polygon
    std::uint32_t first_corner = 0, corner_count = 0;  // 0 corners: not a polygon
    double touch = 0.0;                                // 1e-9 of its diameter
    double slack = 0.0;
  };
  struct End {  // of a segment
    std::uint32_t owner;
    double touch = 0.0, base;
  };
  struct Line {
    const Segment& segment;
    RayFrame frame;
    SlabTest slabs;
    explicit Line(const Segment& s) : segment(s), frame(s), slabs(s) {}
  };
  struct Nearest {
    Hit hit{infinity, no_object, 0, true};
    double limit = infinity;
  };

  struct Exact;
  struct Asker;
  [[nodiscard]] std::uint32_t occluded16(const Segments16& segments, const std::uint32_t* list, std::uint32_t count, bool rooms_clear,
                                         std::uint32_t& hint) const;
  [[nodiscard]] OccluderList list_of(const OccluderList* parent, const PatchShape& a, const PatchShape& b) const;
  [[nodiscard]] bool within(std::uint32_t object, std::span<const glm::dvec3> points) const;
  [[nodiscard]] bool rooms_clear(const PatchShape& a, const PatchShape& b) const;
  // Is the point in the convex polyhedral room number r, or on its wall as well as rounding can tell? False for other rooms.
  [[nodiscard]] bool in_room(std::size_t r, const glm::dvec3& p, double bulge = 0.0) const {
    const std::uint32_t first = first_wall_[r], end = first_wall_[r + 1];
    for (std::uint32_t k = first; k < end; ++k)
      if (!(glm::dot(walls_[k].normal, p - walls_[k].point) >= bulge - 0.5 * rounding_)) return false;
    return first < end;
  }
  [[nodiscard]] std::uint32_t blocked_by_rooms(const Segments16& segments, const Rays16& rays, std::uint32_t near,
                                               std::uint32_t lanes) const;

  [[nodiscard]] End end_at(std::uint32_t owner) const {
    if (owner == no_object) return {owner, 0.0, rounding_};
    return {owner, records_[owner].touch, rounding_ + records_[owner].slack};
  }
  [[nodiscard]] double skin(const End& end, std::uint32_t i) const {
    return end.base + records_[i].slack + (end.owner == i ? 0.0 : std::min(end.touch, records_[i].touch));
  }
  // How far the point `dt` further on lies from the plane of the surface at the crossing.
  [[nodiscard]] double depth(std::uint32_t i, const Segment& s, const Crossing& at, double dt) const {
    return dt < infinity ? dt * std::abs(along(i, s, at)) : infinity;
  }
  [[nodiscard]] double along(std::uint32_t i, const Segment& s, const Crossing& at) const {
    const Record& r = records_[i];
    return glm::dot(r.corner_count ? r.normal : objects_[i].project(at.sheet, s.at(at.t)).normal, s.direction);
  }
  [[nodiscard]] bool passes(const Line& line, const Record& polygon) const {
    return line.frame.winding(std::span(corners_).subspan(polygon.first_corner, polygon.corner_count)) != 0;
  }
  [[nodiscard]] bool blocks(const Line& line, const End& a, const End& b, std::uint32_t i) const;
  [[nodiscard]] bool blocks_by_spans(const Line& line, const End& a, const End& b, std::uint32_t i) const;
  [[nodiscard]] bool within_owner(const Segment& s, const End& end, bool source, const Span& span, std::uint32_t i) const;
  void approach(const Line& line, const End& a, std::uint32_t i, Nearest& nearest) const;
  void approach_bounded(const Line& line, const End& a, Nearest& nearest) const;
  void offer(const Line& line, const Hit& hit, Nearest& nearest) const;

  std::vector<PlacedObject> objects_;
  std::vector<Record> records_;
  std::vector<glm::dvec3> corners_;
  std::vector<Plane> walls_;                  // of the convex polyhedral rooms, normals inwards
  std::vector<std::uint32_t> first_wall_{0};  // by room
  Compiled compiled_;
  Isa isa_;
  Box bounds_;
  double rounding_ = 0.0, slack_ = 0.0;  // slack_: the largest of all objects
};

inline Scene::Scene(std::vector<PlacedObject> objects, Isa isa) : objects_(std::move(objects)), isa_(isa) {
  // Up to here a loop over all is as fast as the tree. (tests/bench/rays)
  constexpr std::size_t loop_limit = 64;
  double touch = 0.0;
  records_.reserve(objects_.size());
  for (const PlacedObject& object : objects_) {
    Record record;
    if (!object.object().outline().empty()) {
      const std::vector<glm::dvec3> outline = object.outline();
      const Plane plane = plane_of(outline);
      record.normal = plane.normal;
      record.point = plane.point;
      record.first_corner = static_cast<std::uint32_t>(corners_.size());
      record.corner_count = static_cast<std::uint32_t>(outline.size());
      corners_.insert(corners_.end(), outline.begin(), outline.end());
    }
    record.touch = 1e-9 * object.bounds().diameter();
    record.slack = object.slack();
    slack_ = std::max(slack_, record.slack);
    touch = std::max(touch, record.touch);
    records_.push_back(record);
    bounds_.extend(object.bounds());
  }
  rounding_ = 64 * unit_roundoff * bounds_.magnitude();
  Compiler compiler(compiled_, bounds_, rounding_ + 2 * slack_ + touch);
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    const Record& r = records_[i];
    compiler.add(i, objects_[i], std::span<const glm::dvec3>(corners_).subspan(r.first_corner, r.corner_count), r.normal);
  }
  compiler.finish(loop_limit);
  for (const std::uint32_t room : compiled_.rooms) {
    const PlacedObject& object = objects_[room];
    if (object.convex() && object.flat() && object.sheet_count() <= 32)
      for (std::uint32_t sheet = 0; sheet < object.sheet_count(); ++sheet) {
        const SurfacePoint wall = object.project(sheet, object.bounds().centre());
        walls_.push_back({wall.position, wall.normal});
      }
    first_wall_.push_back(static_cast<std::uint32_t>(walls_.size()));
  }
}

inline bool Scene::blocks(const Line& line, const End& a, const End& b, std::uint32_t i) const {
  const Record& r = records_[i];
  if (r.corner_count) {  // a polygon: the ends lie on different sides of its plane, both out of the skin
    if (i == a.owner || i == b.owner) return false;
    const double from = glm::dot(r.normal, line.segment.origin - r.point);
    const double to = from + glm::dot(r.normal, line.segment.direction);
    if ((from > 0.0) == (to > 0.0)) return false;
    if (!(std::abs(from) > skin(a, i)) || !(std::abs(to) > skin(b, i))) return false;
    return passes(line, r);
  }
  const PlacedObject& object = objects_[i];
  if (i == a.owner && i == b.owner && object.convex()) return false;
  double entry = 0.0;
  if (!object.inside() && !line.slabs(object.bounds(), 0.0, 1.0, entry)) return false;
  return blocks_by_spans(line, a, b, i);
}

inline bool Scene::blocks_by_spans(const Line& line, const End& a, const End& b, std::uint32_t i) const {
  const PlacedObject& object = objects_[i];
  const Segment& s = line.segment;
  Spans spans;
  object.spans(s, spans);
  if (spans.empty()) return false;
  const double skin_a = skin(a, i), skin_b = skin(b, i);
  // An end out of the bounds, skin included, cannot touch: the common case, decided without normals.
  const bool near_a = object.inside() || object.bounds().contains(s.origin, skin_a);
  const bool near_b = object.inside() || object.bounds().contains(s.at(1.0), skin_b);
  for (const Span& span : spans) {
    const Crossing &in = span.in, &out = span.out;
    if (out.t <= 0.0) continue;
    if (in.t >= 1.0) break;
    if (i == a.owner && in.t <= 0.0) continue;
    if (i == b.owner && out.t >= 1.0) continue;
    if (near_a && depth(i, s, out, out.t) <= skin_a) continue;
    if (near_b && depth(i, s, in, 1.0 - in.t) <= skin_b) continue;
    // The owner's own span that begins in the skin of the source (a corner of a box, by rounding), and likewise at the target.
    if (near_a && i == a.owner && depth(i, s, in, in.t) <= skin_a) continue;
    if (near_b && i == b.owner && depth(i, s, out, 1.0 - out.t) <= skin_b) continue;
    if (within_owner(s, a, true, span, i) || within_owner(s, b, false, span, i)) continue;
    return true;
  }
  return false;
}

// Does the span of object i end before the segment comes out of its source's owner, or begin after it went into its target's?
inline bool Scene::within_owner(const Segment& s, const End& end, bool source, const Span& span, std::uint32_t i) const {
  if (end.owner == no_object || end.owner == i) return false;
  const PlacedObject& owner = objects_[end.owner];
  const Crossing& inner = source ? span.out : span.in;
  const double near = skin(end, i);
  if (!owner.solid() || !std::isfinite(inner.t) || (!owner.inside() && !owner.bounds().contains(s.at(inner.t), near))) return false;
  Spans own;
  owner.spans(s, own);
  for (const Span& o : own) {
    if (source ? o.in.t > 0.0 || o.out.t <= 0.0 : o.in.t >= 1.0 || o.out.t < 1.0) continue;
    const double beyond = source ? inner.t - o.out.t : o.in.t - inner.t;
    return beyond <= 0.0 || depth(i, s, inner, beyond) <= near;
  }
  return false;
}

inline std::optional<Hit> Scene::closest(const Segment& ray, std::uint32_t source_owner) const {
  if (!has_line(ray)) return std::nullopt;
  const Line line(ray);
  const End a = end_at(source_owner);
  Nearest nearest;
  for (const std::uint32_t i : compiled_.rooms) approach(line, a, i, nearest);
  approach_bounded(line, a, nearest);
  if (nearest.hit.object == no_object) return std::nullopt;
  return nearest.hit;
}

inline void Scene::approach(const Line& line, const End& a, std::uint32_t i, Nearest& nearest) const {
  const Record& r = records_[i];
  const Segment& s = line.segment;
  if (r.corner_count) {
    if (i == a.owner) return;
    const double from = glm::dot(r.normal, s.origin - r.point), step = glm::dot(r.normal, s.direction);
    if (step == 0.0 || (from > 0.0) == (step > 0.0) || !(std::abs(from) > skin(a, i))) return;
    const double t = -from / step;
    if (t <= nearest.limit && passes(line, r)) offer(line, Hit{t, i, 0, step < 0.0}, nearest);
    return;
  }
  const PlacedObject& object = objects_[i];
  double entry = 0.0;
  if (!object.inside() && !line.slabs(object.bounds(), 0.0, nearest.limit, entry)) return;
  Spans spans;
  object.spans(s, spans);
  const double skin_a = skin(a, i);
  const bool near_a = object.inside() || object.bounds().contains(s.origin, skin_a);
  for (const Span& span : spans) {
    if (!(span.in.t > 0.0)) continue;
    if (near_a && depth(i, s, span.out, span.out.t) <= skin_a) continue;
    if (near_a && i == a.owner && depth(i, s, span.in, span.in.t) <= skin_a) continue;
    if (span.in.t <= nearest.limit) offer(line, Hit{span.in.t, i, span.in.sheet, object.solid() || along(i, s, span.in) < 0.0}, nearest);
    return;
  }
}

// Takes the hit if it is nearer, or as near as rounding can tell and covering. Ties are looked for within 1000 skins along the ray: beyond
// that the ray grazes at less than a thousandth of a right angle, and the nearer parameter decides.
inline void Scene::offer(const Line& line, const Hit& hit, Nearest& nearest) const {
  const double length = glm::length(line.segment.direction);
  Hit& best = nearest.hit;
  bool take = best.object == no_object || hit.t < best.t;
  if (best.object != no_object) {
    const End other = end_at(best.object);
    const double tolerance = skin(other, hit.object), gap = std::abs(hit.t - best.t);
    if (gap * length <= 1000 * tolerance && gap * std::abs(along(hit.object, line.segment, {hit.t, hit.sheet})) <= tolerance)
      take = hit.front != best.front ? hit.front : hit.object > best.object;
  }
  if (!take) return;
  best = hit;
  const Record& r = records_[hit.object];
  nearest.limit = hit.t + 1000 * (rounding_ + r.slack + slack_ + r.touch) / length;
}

inline bool Scene::covered(const glm::dvec3& p, const glm::dvec3& n, std::uint32_t owner) const {
  const Segment out_of_p{p, n};  // t is a length
  const Line line(out_of_p);
  const End end = end_at(owner);
  const auto covers = [&](std::uint32_t i) {
    if (i == owner) return false;
    const PlacedObject& object = objects_[i];
    const Record& r = records_[i];
    const double near = skin(end, i);
    if (!object.inside() && !object.bounds().contains(p, near)) return false;
    // A coincident surface of object i, its normal at a cosine to n: parallel within 2.5 degrees counts as the same direction.
    const auto coincides = [&](double cosine) { return cosine > 0.999 && i > owner; };
    if (r.corner_count) return std::abs(glm::dot(r.normal, p - r.point)) <= near && coincides(glm::dot(r.normal, n)) && passes(line, r);
    Spans spans;
    object.spans(out_of_p, spans);
    for (const Span& span : spans) {
      if (object.solid() && span.in.t <= near && span.out.t > near) return true;
      if (std::abs(span.out.t) <= near && coincides(along(i, out_of_p, span.out))) return true;
    }
    return false;
  };
  const double near = end.base + slack_ + end.touch;  // at least every skin
  return std::any_of(compiled_.rooms.begin(), compiled_.rooms.end(), covers) || objects_along(compiled_, out_of_p, -near, near, covers);
}

}  // namespace raycast

#include "bundle.hpp"
#include "shaft.hpp"
