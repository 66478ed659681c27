// SPDX-License-Identifier: MIT

// The first hit of one ray and of sixteen: the fast search of kernels/first.inc, followed by the double-precision law of scene.hpp.
//
// The search covers the part of the ray in a cube around the compiled scene. It returns the polygons that are certainly crossed, and the
// faces of open surfaces and solids that may be, each with bounds of the parameter. Mostly one candidate is left, whose position is then
// computed in double precision as in the law. For all other objects the law is evaluated.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/kernels.hpp>
#include <raycast/line_query.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

HALFLIGHT_INLINE bool Scene::Search::clip(const Compiled& scene) {
  const glm::dvec3 o = scene.local(ray.origin), d = ray.direction * scene.scale;
  t0 = 0.0, t1 = infinity;
  for (int k = 0; k < 3; ++k) {
    const double lo = (-lane_cube - o[k]) / d[k], hi = (lane_cube - o[k]) / d[k];
    if (d[k] == 0.0 && !(std::abs(o[k]) <= lane_cube)) { return false; }
    if (d[k] == 0.0) { continue; }
    t0 = std::max(t0, std::min(lo, hi));
    t1 = std::min(t1, std::max(lo, hi));
  }
  return t0 < t1;
}

// Evaluates the law for one object.
struct Scene::Asker {
  const Scene& scene;
  Search* searches;  // by lane

  float operator()(unsigned lane, std::uint32_t object) const {
    Search& s = searches[lane];
    if (!s.is_asked(object)) {
      const double before = s.nearest.limit;
      scene.approach(Line(s.ray), s.source, object, s.nearest);
      s.set_asked(object, s.nearest.limit > before);
    }
    return static_cast<float>(std::min((s.nearest.limit - s.t0) / (s.t1 - s.t0), 1.0)) * limit_up + eps_limit;
  }
  // Does the origin lie on the object or near its bounds? Then an end may merely touch it.
  [[nodiscard]] bool near(unsigned lane, std::uint32_t object) const {
    const Search& s = searches[lane];
    return object == s.source.owner || scene.objects_[object].bounds().contains(s.ray.origin, 2 * scene.skin(s.source, object));
  }
  // Does a face of such a solid, not certainly crossed, matter? On the solid from which the ray comes, not if it is crossed behind the
  // origin or within the skin, as faces beside the one at the origin are.
  [[nodiscard]] bool matters(unsigned lane, std::uint32_t object, std::uint32_t face) const {
    const Search& s = searches[lane];
    if (scene.objects_[object].winding(s.ray, face) == 0) { return false; }
    const double skin = scene.skin(s.source, object);
    if (object != s.source.owner || !scene.objects_[object].bounds().contains(s.ray.origin, skin)) { return true; }
    const Crossing at = scene.objects_[object].crossing(s.ray, face);
    return at.t > 0.0 && scene.depth(object, s.ray, at, at.t) > skin;
  }
};

// The first crossing of the ray with the object of entry i, as its spans have it. t is infinite if there is none; nothing is returned if
// only the spans can tell. A solid's first entry is the beginning of a span if no face is left before it, because crossings then pair
// with it. Of an open surface all crossings count, so the first is known once it lies before `limit`, up to which no face is missing; if
// two of its faces coincide, the law decides, because it prefers a front.
HALFLIGHT_INLINE std::optional<Crossing> Scene::first_crossing(const Search& search, const Entries& entries, unsigned i,
                                                               float limit) const {
  if (!entries.complete) { return std::nullopt; }
  const std::uint32_t object = entries.entry[i].object;
  const bool solid = compiled_.roles[object] == Role::solid, only = entries.count == 1 && entries.entry[0].sure;
  Crossing first{infinity, 0}, second = first;
  bool known = only;
  for (unsigned j = i; j < entries.count; ++j) {
    const Entries::Entry& e = entries.entry[j];
    if (e.object != object) { continue; }
    const bool before = e.timed && e.to <= limit;
    if (solid && !only && !(before && e.to < entries.exit)) { return std::nullopt; }
    if (solid && !e.sure && objects_[object].winding(search.ray, e.face) >= 0) { continue; }
    const Crossing at = objects_[object].crossing(search.ray, e.face);
    if (!solid && !e.sure && !meets_face(search.ray, search.source, object, e.face, at)) { continue; }
    known = known || solid || before;
    if (at.t < first.t || (at.t == first.t && at.sheet < first.sheet)) {
      second = std::exchange(first, at);
    } else if (at.t < second.t) {
      second = at;
    }
  }
  if (!known && first.t < infinity) { return std::nullopt; }
  if (!solid && second.t < infinity &&
      ties(search.ray, Hit{first.t, object, first.sheet, true}, Hit{second.t, object, second.sheet, true})) {
    return std::nullopt;
  }
  return first;
}

// Decides among the candidates that the search returned, which are complete up to `limit`.
HALFLIGHT_INLINE void Scene::decide(Search& search, const Entries& entries, float limit) const {
  const Segment& ray = search.ray;
  Nearest& nearest = search.nearest;
  for (unsigned i = 0; i < entries.count; ++i) {
    const std::uint32_t object = entries.entry[i].object;
    const auto other = [&](const Entries::Entry& e) { return e.object != object; };
    if (!std::all_of(entries.entry, entries.entry + i, other) || search.is_asked(object)) { continue; }
    if (const Record& r = records_[object]; r.corner_count) {  // a certainly crossed polygon: computed as in approach()
      const double step = glm::dot(r.normal, ray.direction), t = -glm::dot(r.normal, ray.origin - r.point) / step;
      if (t <= nearest.limit) { offer(ray, Hit{t, object, 0, step < 0.0}, nearest); }
      continue;
    }
    const std::optional<Crossing> first = first_crossing(search, entries, i, limit);
    if (!first) {
      approach(Line(ray), search.source, object, nearest);
    } else if (first->t > 0.0 && first->t < infinity && first->t <= nearest.limit) {
      const bool front = compiled_.roles[object] == Role::solid || along(object, ray, *first) < 0.0;
      offer(ray, Hit{first->t, object, first->sheet, front}, nearest);
    }
  }
  if (entries.complete) { return; }
  const Line line(ray);
  objects_along(compiled_, ray, 0.0, nearest.limit, [&](std::uint32_t i) {
    if (compiled_.roles[i] != Role::polygon && !left_out_[i] && !is_far(i)) { approach(line, search.source, i, nearest); }
    return false;
  });
  for (const Guard& room : compiled_.face_rooms) { approach(line, search.source, room.object, nearest); }
}

HALFLIGHT_INLINE void Scene::approach_bounded(Search& search) const {
  if (compiled_.nodes.empty() || !search.clip(compiled_)) { return; }
  const Segment& ray = search.ray;
  const glm::dvec3 o = compiled_.local(ray.origin), d = ray.direction * compiled_.scale;
  const glm::dvec3 from = o + search.t0 * d, along = (search.t1 - search.t0) * d;
  const Segment inner{from / compiled_.scale + compiled_.centre, along / compiled_.scale};
  Rays16 rays;
  if (!(Box{o, o}.magnitude() < farthest_cut) ||
      !HALFLIGHT_DISPATCH(isa_, convert_one(compiled_, inner, search.source.owner, search.source_sheet, no_object, rays))) {
    const Line line(ray);
    objects_along(compiled_, ray, 0.0, search.nearest.limit, [&](std::uint32_t i) {
      approach(line, search.source, i, search.nearest);
      return false;
    });
    for (const Guard& room : compiled_.face_rooms) { approach(line, search.source, room.object, search.nearest); }
    return;
  }
  Asker asker{*this, &search};
  Entries entries;
  float limit = 1.0f;
  HALFLIGHT_DISPATCH(isa_, first(compiled_, rays, 0, 0, limit, entries, asker));
  decide(search, entries, limit);
}

HALFLIGHT_INLINE void Scene::approach_far(Search& search) const {
  if (far_.empty() || !has_line(search.ray)) { return; }
  const glm::dvec3 o = compiled_.local(search.ray.origin);
  if (search.nearest.hit.object != no_object && Box{o, o}.magnitude() < lane_reach) { return; }
  const Line line(search.ray);
  for (const std::uint32_t i : far_) { approach(line, search.source, i, search.nearest); }
}

HALFLIGHT_INLINE void Scene::approach_rooms(Search& search) const {
  if (compiled_.rooms.empty() || !has_line(search.ray)) { return; }
  const Hit& hit = search.nearest.hit;
  const glm::dvec3 at = hit.object != no_object ? search.ray.at(hit.t) : glm::dvec3{0.0};
  const double beyond_ties = compiled_.margin / compiled_.scale;
  for (std::size_t r = 0; r < compiled_.rooms.size(); ++r) {
    if (hit.object != no_object && in_room(r, at, beyond_ties)) { continue; }
    approach(Line(search.ray), search.source, compiled_.rooms[r], search.nearest);
  }
}

// Returns the lanes that remain: those for which the other caster cannot decide, and those whose hit may lie on two coincident surfaces,
// of which one must be chosen (as in covered(), and a front before a back).
HALFLIGHT_INLINE std::uint32_t Scene::met_by_other(const Segments16& rays, Hits16& hits) const {
  std::uint32_t left = other_.closest16(rays, hits) & rays.lanes;
  hits.met &= rays.lanes & ~left;
  for (std::uint32_t rest = hits.met; rest; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    const Hit& hit = hits.hit[i];
    const SurfacePoint at = objects_[hit.object].project(hit.sheet, rays.at(i).at(hit.t));
    if (!hit.front || covered(at.position, at.normal, hit.object)) { left |= 1u << i; }
  }
  hits.met &= ~left;
  return left;
}

HALFLIGHT_INLINE Hits16 Scene::closest16(const Segments16& rays) const {
  Hits16 result;
  Search searches[16];
  Segments16 inner;
  const double per_scale = 1.0 / compiled_.scale;  // a power of two
  const std::uint32_t lanes = other_.closest16 ? met_by_other(rays, result) : rays.lanes;
  for (std::uint32_t rest = lanes; rest; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    Search& s = searches[i];
    s = {rays.at(i), end_at(rays.source[i]), rays.source_sheet[i]};
    if (!has_line(s.ray)) { continue; }
    const glm::dvec3 o = compiled_.local(s.ray.origin), d = s.ray.direction * compiled_.scale;
    if (!(Box{o, o}.magnitude() < farthest_cut)) {
      approach_bounded(s);
    } else if (s.clip(compiled_)) {
      inner.set(i, {(o + s.t0 * d) * per_scale + compiled_.centre, (s.t1 - s.t0) * d * per_scale}, s.source.owner, no_object,
                s.source_sheet);
    }
  }
  if (inner.lanes && !compiled_.nodes.empty()) {
    Rays16 converted;
    unsigned lines = 0;
    const unsigned near = HALFLIGHT_DISPATCH(isa_, convert(compiled_, inner, converted, lines));
    Asker asker{*this, searches};
    Entries entries[16];
    alignas(64) float limits[16];
    std::fill(limits, limits + 16, 1.0f);
    HALFLIGHT_DISPATCH(isa_, first16(compiled_, converted, near, limits, entries, asker));
    for (std::uint32_t rest = inner.lanes; rest; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      if (near >> i & 1u) {
        decide(searches[i], entries[i], limits[i]);
      } else {
        approach_bounded(searches[i]);
      }
    }
  }
  for (std::uint32_t rest = lanes; rest; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    approach_far(searches[i]);
    approach_rooms(searches[i]);
    result.hit[i] = searches[i].nearest.hit;
    result.met |= static_cast<std::uint32_t>(result.hit[i].object != no_object) << i;
  }
  return result;
}

}  // namespace raycast
