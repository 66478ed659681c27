// SPDX-License-Identifier: MIT
#include <brep/csg/contacts.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/point_table.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE bool Contacts::meet(std::uint32_t f, std::uint32_t g) {
  const WorkFace &ff = work_.faces[f], &gg = work_.faces[g];
  const PlaneNumber p = ff.plane.number(), q = gg.plane.number();
  if (p == q || !sides(ff, q, sides_f_) || !sides(gg, p, sides_g_)) { return false; }
  const Line line(work_.predicates.plane(p), work_.predicates.plane(q));
  if (line.axis < 0) { return false; }
  axis_ = line.axis;
  events_.clear();
  along_.clear();
  collect(ff, q, sides_f_, false);
  const std::size_t middle = events_.size();
  collect(gg, p, sides_g_, true);
  if (middle == 0 || middle == events_.size()) { return false; }
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (const Event& e : events_) {
    low[e.of_g] = std::min(low[e.of_g], e.point.position[axis_]);
    high[e.of_g] = std::max(high[e.of_g], e.point.position[axis_]);
  }
  if (low[0] > high[1] || low[1] > high[0]) { return false; }
  std::sort(events_.begin(), events_.end(),
            [&](const Event& a, const Event& b) { return work_.predicates.compare(a.point, b.point, axis_) < 0; });
  groups_.clear();
  for (std::uint32_t i = 0; i < events_.size(); ++i) {
    if (i == 0 || work_.predicates.compare(events_[i - 1].point, events_[i].point, axis_) != 0) { groups_.push_back(i); }
    events_[i].group = static_cast<std::uint32_t>(groups_.size() - 1);
  }
  groups_.push_back(static_cast<std::uint32_t>(events_.size()));
  for (Along& a : along_) {
    for (const Event& e : events_) {
      if (!e.vertex || (e.of_g != 0) != a.of_g) { continue; }
      if (e.half == a.half) { a.first = e.group; }
      if (e.half == work_.halves[a.half].next) { a.last = e.group; }
    }
    if (a.first > a.last) { std::swap(a.first, a.last); }
  }
  return true;
}

HALFLIGHT_INLINE bool Contacts::sides(const WorkFace& f, PlaneNumber q, std::vector<std::int8_t>& result) const {
  result.resize(f.count);
  bool front = false, back = false, on = false;
  for (std::uint32_t i = 0; i < f.count; ++i) {
    const int s = work_.predicates.side(work_.from(f.first + i), q);
    result[i] = static_cast<std::int8_t>(s);
    front = front || s > 0;
    back = back || s < 0;
    on = on || s == 0;
  }
  return on || (front && back);
}

HALFLIGHT_INLINE void Contacts::collect(const WorkFace& f, PlaneNumber q, const std::vector<std::int8_t>& side, bool of_g) {
  for (std::uint32_t i = 0; i < f.count; ++i) {
    const std::uint32_t h = f.first + i;
    const WorkHalf& half = work_.halves[h];
    const int s = side[i], after = side[half.next - f.first];
    if (s * after < 0) {
      const PlaneNumber p = f.plane.number();
      // Both ways along the edge must name the same planes in the same order: equal names are cheaper to compare.
      const Point x = work_.predicates.point(std::min(p, half.across), std::max(p, half.across), q);
      events_.push_back({x, h, of_g, false, 3, 0});
    } else if (s == 0) {
      const int before = side[half.prev - f.first];
      const int turn = ((after > 0) != (before > 0) ? 1 : 0) | ((after < 0) != (before < 0) ? 2 : 0);
      events_.push_back({work_.points[half.point], h, of_g, true, static_cast<std::uint8_t>(turn), 0});
      if (after == 0) { along_.push_back({h, 0, 0, of_g}); }
    }
  }
}

HALFLIGHT_INLINE void Contacts::walk(std::uint32_t f, std::uint32_t g) {
  const PlaneNumber p = work_.faces[f].plane.number(), q = work_.faces[g].plane.number();
  int state_f = 0, state_g = 0;
  std::uint32_t before = invalid_index;  // the common point at the beginning of the interval, if both run there
  const auto count = static_cast<std::uint32_t>(groups_.size() - 1);
  for (std::uint32_t k = 0; k < count; ++k) {
    int after_f = state_f, after_g = state_g;
    bool at_f = state_f != 0, at_g = state_g != 0;
    for (std::uint32_t i = groups_[k]; i < groups_[k + 1]; ++i) {
      (events_[i].of_g ? at_g : at_f) = true;
      (events_[i].of_g ? after_g : after_f) ^= events_[i].turn;
    }
    std::uint32_t here = invalid_index;
    if (at_f && at_g) {
      here = resolve(k);
      if (before != invalid_index) {
        if (!run_along(k, false)) { state_f == 3 ? segments.push_back({f, before, here, q}) : void(consistent = false); }
        if (!run_along(k, true)) { state_g == 3 ? segments.push_back({g, before, here, p}) : void(consistent = false); }
      }
    }
    state_f = after_f, state_g = after_g;
    before = state_f != 0 && state_g != 0 ? here : invalid_index;
  }
  consistent = consistent && state_f == 0 && state_g == 0;
}

HALFLIGHT_INLINE std::uint32_t Contacts::resolve(std::uint32_t k) {
  std::uint32_t number = invalid_index;
  for (std::uint32_t i = groups_[k]; i < groups_[k + 1]; ++i) {
    if (events_[i].vertex) { number = table.of_vertex(work_.halves[events_[i].half].point); }
  }
  if (number == invalid_index) { number = table.of(events_[groups_[k]].point); }
  for (std::uint32_t i = groups_[k]; i < groups_[k + 1]; ++i) {
    if (!events_[i].vertex) { nodes.push_back({lower(events_[i].half), number}); }
  }
  for (const Along& a : along_) {
    if (a.first < k && k < a.last) { nodes.push_back({lower(a.half), number}); }
  }
  return number;
}

HALFLIGHT_INLINE bool Contacts::run_along(std::uint32_t k, bool of_g) {
  bool found = false;
  for (const Along& a : along_) {
    if (a.of_g != of_g || a.first >= k || a.last < k) { continue; }
    along.push_back(lower(a.half));
    found = true;
  }
  return found;
}

}  // namespace brep::csg::detail
