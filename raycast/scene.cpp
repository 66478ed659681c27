// SPDX-License-Identifier: MIT
// Implements the law of scene.hpp, and the compilation of objects.

#include <raycast/scene.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/bvh.hpp>
#include <raycast/compile.hpp>
#include <raycast/compiled.hpp>
#include <raycast/far_objects.hpp>
#include <raycast/isa.hpp>
#include <raycast/object.hpp>
#include <raycast/planar.hpp>
#include <raycast/point_query.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>
#include <raycast/wide_tree.hpp>

namespace raycast {

HALFLIGHT_INLINE Scene::Scene(std::vector<PlacedObject> objects, Isa isa)
    : objects_(std::move(objects)), left_out_(objects_.size()), isa_(isa) {
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
    record.touch = tol_contact * object.bounds().diameter();
    record.slack = object.slack();
    slack_ = std::max(slack_, record.slack);
    records_.push_back(record);
    bounds_.extend(object.bounds());
  }
  far_ = far_objects(objects_);
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    if (!is_far(i)) { near_.extend(objects_[i].bounds()); }
  }
  rounding_ = eps_surface * bounds_.magnitude();
  compile();
}

HALFLIGHT_INLINE void Scene::leave_out(std::span<const std::uint32_t> copies) {
  for (const std::uint32_t i : copies) { left_out_[i] = true; }
  if (!copies.empty()) { compile(); }
}

HALFLIGHT_INLINE void Scene::compile() {
  // Up to this number of shapes, a loop over all is as fast as the tree (tests/bench/rays).
  constexpr std::size_t loop_limit = 64;
  double touch = 0.0;
  for (const Record& record : records_) { touch = std::max(touch, record.touch); }
  compiled_ = {}, walls_.clear();
  // Half the scale leaves room around the scene, where segments to far objects are cut (occluder_lists.cpp).
  const Box bounds = far_.empty() ? near_ : near_.grown(0.5 * std::max({near_.size().x, near_.size().y, near_.size().z}));
  Compiler compiler(compiled_, bounds, rounding_ + 2 * slack_ + touch);
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    const Record& r = records_[i];
    const auto outline = std::span<const glm::dvec3>(corners_).subspan(r.first_corner, r.corner_count);
    compiler.add(i, objects_[i], outline, r.normal, left_out_[i] || is_far(i) ? Compiler::Rays::pass : Compiler::Rays::meet);
  }
  compiler.finish(loop_limit);
  guard_of_.assign(objects_.size(), no_shape);
  for (std::uint32_t g = 0; g < compiled_.guards.size(); ++g) { guard_of_[compiled_.guards[g].object] = g; }
  placed_.clear();
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    if (left_out_[i] || objects_[i].inside()) { continue; }
    placed_.push_back(i);
    boxes.push_back(objects_[i].bounds());
  }
  places_ = Bvh(boxes);
  constexpr std::uint32_t most_planes = 32, most_curved = 3;
  for (const std::uint32_t room : compiled_.rooms) {
    const PlacedObject& object = objects_[room];
    Walls& walls = walls_.emplace_back();
    if (!object.convex() || object.sheet_count() > (object.flat() ? most_planes : most_curved)) { continue; }
    if (!object.flat()) {
      const bool tells = object.object().nearest() && keeps_angles(object.placement().linear);
      walls.curved_sheets = tells ? object.sheet_count() : 0;
      continue;
    }
    for (std::uint32_t sheet = 0; sheet < object.sheet_count(); ++sheet) {
      const SurfacePoint wall = object.project(sheet, object.bounds().centre());
      walls.planes.push_back({wall.position, wall.normal});
    }
  }
}

HALFLIGHT_INLINE bool Scene::blocks(const Line& line, const End& a, const End& b, std::uint32_t i) const {
  const Record& r = records_[i];
  if (r.corner_count) {  // a polygon: the ends lie on different sides of its plane, both beyond the skin
    if (i == a.owner || i == b.owner) { return false; }
    const double from = glm::dot(r.normal, line.segment.origin - r.point);
    const double to = from + glm::dot(r.normal, line.segment.direction);
    if ((from > 0.0) == (to > 0.0)) { return false; }
    if (!(std::abs(from) > skin(a, i)) || !(std::abs(to) > skin(b, i))) { return false; }
    return passes(line, r);
  }
  const PlacedObject& object = objects_[i];
  // A room whose body the line passes through once is solid before and behind it: these two spans belong to the ends.
  if (i == a.owner && i == b.owner && (object.convex() || (object.inside() && object.passes_once(line.segment)))) { return false; }
  double entry = 0.0;
  if (!object.inside() && !line.slabs(object.bounds(), 0.0, 1.0, entry)) { return false; }
  return blocks_by_spans(line.segment, a, b, i);
}

// Does a span of object i block the segment?
struct Scene::Stops {
  const Scene& scene;
  const Segment& s;
  const End &a, &b;
  std::uint32_t i;
  double skin_a = scene.skin(a, i), skin_b = scene.skin(b, i);
  // An end outside the bounds, skin included, cannot touch. This common case is decided without normals.
  bool near_a = scene.objects_[i].inside() || scene.objects_[i].bounds().contains(s.origin, skin_a);
  bool near_b = scene.objects_[i].inside() || scene.objects_[i].bounds().contains(s.at(1.0), skin_b);

  [[nodiscard]] double depth(const Crossing& at, double dt) const { return scene.depth(i, s, at, dt); }
  [[nodiscard]] bool operator()(const Span& span) const {
    const Crossing &in = span.in, &out = span.out;
    if (out.t <= 0.0 || in.t >= 1.0) { return false; }
    if (i == a.owner && in.t <= 0.0) { return false; }
    if (i == b.owner && out.t >= 1.0) { return false; }
    const auto begins = [&] { return in.t <= 0.0 || depth(in, in.t) <= skin_a; };
    const auto ends = [&] { return out.t >= 1.0 || depth(out, 1.0 - out.t) <= skin_b; };
    if (near_a && depth(out, out.t) <= skin_a && begins()) { return false; }
    if (near_b && depth(in, 1.0 - in.t) <= skin_b && ends()) { return false; }
    // The owner's own span that begins within the skin of the source (at a corner of a box, by rounding); likewise at the target.
    if (near_a && i == a.owner && depth(in, in.t) <= skin_a) { return false; }
    if (near_b && i == b.owner && depth(out, 1.0 - out.t) <= skin_b) { return false; }
    return !scene.within_owner(s, a, true, span, i) && !scene.within_owner(s, b, false, span, i);
  }
};

HALFLIGHT_INLINE bool Scene::blocks_by_spans(const Segment& s, const End& a, const End& b, std::uint32_t i) const {
  Spans spans;
  objects_[i].spans_near(s, 0.0, 1.0, spans);
  return !spans.empty() && std::any_of(spans.begin(), spans.end(), Stops{*this, s, a, b, i});
}

HALFLIGHT_INLINE bool Scene::blocks_by_face(const Segment& s, const End& a, const End& b, std::uint32_t i, std::uint32_t face) const {
  if (objects_[i].winding(s, face) == 0) { return false; }
  const Crossing at = objects_[i].crossing(s, face);
  return Stops{*this, s, a, b, i}(Span{at, at});
}

HALFLIGHT_INLINE bool Scene::meets_face(const Segment& ray, const End& source, std::uint32_t i, std::uint32_t face,
                                        const Crossing& at) const {
  if (!(at.t > 0.0) || objects_[i].winding(ray, face) == 0) { return false; }
  const double near = skin(source, i);
  return !objects_[i].bounds().contains(ray.origin, near) || depth(i, ray, at, at.t) > near;
}

HALFLIGHT_INLINE bool Scene::touches(const glm::dvec3& p, const End& end, std::uint32_t object, std::uint32_t sheet) const {
  const SurfacePoint on = objects_[object].project(sheet, p);
  return std::abs(glm::dot(on.normal, p - on.position)) <= 0.5 * skin(end, object);
}

// Does the span of object i begin and end before the segment leaves the owner of its source, or after it enters the owner of its target?
HALFLIGHT_INLINE bool Scene::within_owner(const Segment& s, const End& end, bool source, const Span& span, std::uint32_t i) const {
  if (end.owner == no_object || end.owner == i) { return false; }
  const PlacedObject& owner = objects_[end.owner];
  const Crossing& inner = source ? span.out : span.in;
  const double near = skin(end, i);
  if (!owner.solid() || !std::isfinite(inner.t) || (!owner.inside() && !owner.bounds().contains(s.at(inner.t), near))) { return false; }
  Spans own;
  owner.spans(s, own);
  for (const Span& o : own) {
    if (source ? o.in.t > 0.0 || o.out.t <= 0.0 : o.in.t >= 1.0 || o.out.t < 1.0) { continue; }
    const auto reached = [&](const Crossing& at) {
      const double beyond = source ? at.t - o.out.t : o.in.t - at.t;
      return beyond <= 0.0 || depth(i, s, at, beyond) <= near;
    };
    return reached(inner) && reached(source ? span.in : span.out);
  }
  return false;
}

HALFLIGHT_INLINE std::optional<Hit> Scene::closest(const Segment& ray, std::uint32_t source_owner, std::uint32_t source_sheet) const {
  if (!has_line(ray)) { return std::nullopt; }
  if (other_.closest16) {
    Segments16 rays;
    rays.set(0, ray, source_owner, no_object, source_sheet);
    const Hits16 hits = closest16(rays);
    return hits.met != 0 ? std::optional(hits.hit[0]) : std::nullopt;
  }
  Search search{ray, end_at(source_owner), source_sheet};
  approach_bounded(search);
  approach_far(search);
  approach_rooms(search);
  if (search.nearest.hit.object == no_object) { return std::nullopt; }
  return search.nearest.hit;
}

HALFLIGHT_INLINE void Scene::approach(const Line& line, const End& a, std::uint32_t i, Nearest& nearest) const {
  const Record& r = records_[i];
  const Segment& s = line.segment;
  if (r.corner_count) {
    if (i == a.owner) { return; }
    const double from = glm::dot(r.normal, s.origin - r.point), step = glm::dot(r.normal, s.direction);
    if (step == 0.0 || (from > 0.0) == (step > 0.0) || !(std::abs(from) > skin(a, i))) { return; }
    const double t = -from / step;
    if (t <= nearest.limit && passes(line, r)) { offer(s, Hit{t, i, 0, step < 0.0}, nearest); }
    return;
  }
  const PlacedObject& object = objects_[i];
  double entry = 0.0;
  if (!object.inside() && !line.slabs(object.bounds(), 0.0, nearest.limit, entry)) { return; }
  Spans spans;
  object.spans_near(s, 0.0, nearest.limit, spans);
  const double skin_a = skin(a, i);
  const bool near_a = object.inside() || object.bounds().contains(s.origin, skin_a);
  for (const Span& span : spans) {
    if (!(span.in.t > 0.0)) { continue; }
    if (near_a && depth(i, s, span.in, span.in.t) <= skin_a && (i == a.owner || depth(i, s, span.out, span.out.t) <= skin_a)) { continue; }
    if (!(span.in.t <= nearest.limit)) { return; }
    offer(s, Hit{span.in.t, i, span.in.sheet, object.solid() || along(i, s, span.in) < 0.0}, nearest);
    if (object.solid()) { return; }  // on an open surface another face may lie at the same place and show its front
  }
}

// Is the hit as near as `first`, the nearest one, within rounding? Ties are recognised only within `tie_reach`; beyond that the nearer
// parameter decides.
HALFLIGHT_INLINE bool Scene::ties(const Segment& ray, const Hit& first, const Hit& hit) const {
  const double tolerance = skin(end_at(first.object), hit.object), gap = std::abs(hit.t - first.t);
  return gap * glm::length(ray.direction) <= tie_reach * tolerance &&
         gap * std::abs(along(hit.object, ray, {hit.t, hit.sheet})) <= tolerance;
}

// Of the hits that tie with the nearest one, the covering one is taken. All of them are stored: if each were compared only with the one
// taken before, a chain of surfaces, each within the tolerance of the next, would lead away from the first.
HALFLIGHT_INLINE void Scene::offer(const Segment& ray, const Hit& hit, Nearest& nearest) const {
  auto& [best, limit, count, tied] = nearest;
  const bool first = count == 0 || hit.t < tied[0].t;
  if (!first && !ties(ray, tied[0], hit)) { return; }
  // A hit that was found before takes no place, so that copies of one surface leave room for the others.
  const auto same = [&](const Hit& other) { return other.object == hit.object && other.sheet == hit.sheet && other.t == hit.t; };
  if (std::any_of(tied.begin(), tied.begin() + count, same)) { return; }
  if (first) {
    const std::uint32_t before = std::exchange(count, 1);
    const auto others = tied;
    tied[0] = hit;
    for (std::uint32_t k = 0; k < before && count < tied.size(); ++k) {
      if (ties(ray, hit, others[k])) { tied[count++] = others[k]; }
    }
    const Record& r = records_[hit.object];
    limit = hit.t + tie_reach * (rounding_ + r.slack + slack_ + r.touch) / glm::length(ray.direction);
  } else if (count < tied.size()) {
    tied[count++] = hit;
  } else if (tied.back().object < hit.object) {
    tied.back() = hit;
  }
  const auto covers = [](const Hit& a, const Hit& b) { return a.front != b.front ? b.front : a.object < b.object; };
  best = *std::max_element(tied.begin(), tied.begin() + count, covers);
}

HALFLIGHT_INLINE bool Scene::covered(const glm::dvec3& p, const glm::dvec3& n, std::uint32_t owner) const {
  if (owner != no_object && left_out_[owner]) { return true; }
  const Segment out_of_p{p, n};  // unit direction, so t is a length
  const Line line(out_of_p);
  const End end = end_at(owner);
  struct Coincident {
    std::uint32_t object;
    glm::dvec3 point, normal;
  };
  std::vector<Coincident> later;  // usually empty
  const glm::vec3 local{compiled_.local(p)};
  const auto in_air = [&](const Guard& solid) { return solid.air.contains(local.x, local.y, local.z); };
  const auto covers = [&](std::uint32_t i) {
    if (i == owner) { return false; }
    const PlacedObject& object = objects_[i];
    const Record& r = records_[i];
    const double near = skin(end, i);
    if (!object.inside() && !object.bounds().contains(p, near)) { return false; }
    if (guard_of_[i] != no_shape && in_air(compiled_.guards[guard_of_[i]])) { return false; }
    const bool may_cover = i > owner && !left_out_[i];
    if (r.corner_count) {
      const double off = glm::dot(r.normal, p - r.point);
      if (may_cover && std::abs(off) <= near && glm::dot(r.normal, n) > tol_same_way && passes(line, r)) {
        later.push_back({i, p - off * r.normal, r.normal});
      }
      return false;
    }
    Spans spans;
    object.spans_near(out_of_p, -near, near, spans);
    for (const Span& span : spans) {
      if (object.solid() && span.in.t <= near && span.out.t > near) { return true; }
      if (may_cover && std::abs(span.out.t) <= near && along(i, out_of_p, span.out) > tol_same_way) {
        const SurfacePoint at = object.project(span.out.sheet, out_of_p.at(span.out.t));
        later.push_back({i, at.position, at.normal});
      }
    }
    return false;
  };
  const double near = end.base + slack_ + end.touch;  // upper bound of every skin
  const auto room_covers = [&](const Guard& room) { return !in_air(room) && covers(room.object); };
  if (std::any_of(compiled_.rooms.begin(), compiled_.rooms.end(), covers)) { return true; }
  if (std::any_of(compiled_.face_rooms.begin(), compiled_.face_rooms.end(), room_covers)) { return true; }
  const auto at_p = [&](const Box& box) { return box.contains(p, near); };
  if (any_within(places_, at_p, [&](std::uint32_t item) { return covers(placed_[item]); })) { return true; }
  // A covered surface covers nothing: in a chain of surfaces, each coincident with the next, the first would otherwise cover the last.
  std::sort(later.begin(), later.end(), [](const Coincident& a, const Coincident& b) { return a.object > b.object; });
  return std::any_of(later.begin(), later.end(), [&](const Coincident& c) { return !covered(c.point, c.normal, c.object); });
}

}  // namespace raycast
