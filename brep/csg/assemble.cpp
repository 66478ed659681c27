// SPDX-License-Identifier: MIT
#include <brep/csg/assemble.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/radial.hpp>
#include <brep/csg/work.hpp>
#include <brep/edge_uses.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE bool Assemble::glue(const Radial& radial) {
  for (std::size_t e = 0; e + 1 < radial.first.size(); ++e) {
    const Spine *begin = radial.spines.data() + radial.first[e], *end = radial.spines.data() + radial.first[e + 1];
    const Spine *last = nullptr, *first = nullptr;
    std::size_t count = 0;
    for (const Spine* s = begin; s != end; ++s) {
      if (!kept(s->half)) { continue; }
      ++count;
      if (last != nullptr && !pair(*last, *s)) { return false; }
      if (last == nullptr) { first = s; }
      last = s;
    }
    if (last != nullptr && !pair(*last, *first)) { return false; }
    for (const Spine* s = begin; count > 2 && s != end; ++s) {
      if (kept(s->half)) { hold(s->half); }
    }
  }
  return true;
}

HALFLIGHT_INLINE void Assemble::straighten_umbrellas() {
  for (std::uint32_t h = 0; h < work_.halves.size(); ++h) {
    if (removed_[h] == gone || !keep_[work_.halves[h].face]) { continue; }
    const std::uint32_t x = work_.halves[h].prev, y = work_.halves[x].twin;
    const std::pair<std::uint32_t, std::uint32_t> pair[] = {{0, h}, {0, y}};
    if (y == h || work_.halves[y].prev != work_.halves[h].twin || !straight(pair, pair + 2)) { continue; }
    drop(h);
  }
}

HALFLIGHT_INLINE Boundary Assemble::run() {
  Boundary result;
  result.touching = touching_;
  std::vector<std::uint32_t> next_of(work_.faces.size(), invalid_index);  // the faces that became one
  for (auto f = static_cast<std::uint32_t>(work_.faces.size()); f-- > 0;) {
    const std::uint32_t root = groups_.find(f);
    if (root != f && keep_[f]) { next_of[f] = std::exchange(next_of[root], f); }
  }
  std::vector<std::uint32_t> new_half(work_.halves.size(), invalid_index), new_point(work_.points.size(), invalid_index), source;
  std::size_t faces = 0, halves = 0;
  for (std::uint32_t f = 0; f < work_.faces.size(); ++f) {
    if (keep_[f]) { ++faces, halves += work_.faces[f].count; }
  }
  result.faces.reserve(faces);
  source.reserve(halves);
  for (std::uint32_t f = 0; f < work_.faces.size(); ++f) {
    if (!keep_[f] || groups_.find(f) != f) { continue; }
    Face face{work_.faces[f].plane, static_cast<std::uint32_t>(source.size()), 0, work_.faces[f].attribute, work_.faces[f].box};
    for (std::uint32_t member = f; member != invalid_index; member = next_of[member]) {
      const WorkFace& from = work_.faces[member];
      for (std::uint32_t i = 0; i < from.count; ++i) {
        const std::uint32_t h = work_.half(from, i);
        if (removed_[h] == gone) { continue; }
        new_half[h] = static_cast<std::uint32_t>(source.size());
        source.push_back(h);
      }
    }
    face.count = static_cast<std::uint32_t>(source.size()) - face.first;
    if (work_.faces[f].listed || next_of[f] != invalid_index) {
      face.box = {};
      for (std::uint32_t i = face.first; i < source.size(); ++i) {
        face.box.add(work_.from(source[i]).position, work_.from(source[i]).on_grid());
      }
    }
    result.faces.push_back(face);
  }
  result.halves.resize(source.size());
  result.points.reserve(source.size() / 5);  // a sixth in meshes of triangles
  std::uint32_t f = 0;
  for (std::uint32_t i = 0; i < source.size(); ++i) {
    while (i >= result.faces[f].first + result.faces[f].count) { ++f; }
    const WorkHalf& h = work_.halves[source[i]];
    std::uint32_t& point = new_point[h.point];
    if (point == invalid_index) {
      point = static_cast<std::uint32_t>(result.points.size());
      result.points.push_back(work_.points[h.point]);
    }
    result.halves[i] = {point, new_half[h.next], new_half[h.twin], f, h.across};
  }
  return result;
}

HALFLIGHT_INLINE void Assemble::drop(std::uint32_t h) {
  const std::uint32_t x = work_.halves[h].prev, y = work_.halves[x].twin, t = work_.halves[h].twin;
  work_.link(x, work_.halves[h].next);
  work_.link(t, work_.halves[y].next);
  work_.halves[x].twin = t;
  work_.halves[t].twin = x;
  removed_[h] = removed_[y] = gone;
}

HALFLIGHT_INLINE bool Assemble::pair(const Spine& a, const Spine& b) {
  if (a.begins == b.begins) { return false; }
  if (a.begins) {
    work_.halves[a.half].twin = b.half;
    work_.halves[b.half].twin = a.half;
  }
  return true;
}

HALFLIGHT_INLINE bool Assemble::straight(const std::pair<std::uint32_t, std::uint32_t>* begin,
                                         const std::pair<std::uint32_t, std::uint32_t>* end) const {
  const std::uint32_t first = begin->second, ahead = work_.target(first), back = work_.halves[work_.halves[first].prev].point;
  if (ahead == back) { return false; }
  for (const auto* s = begin; s != end; ++s) {
    const std::uint32_t h = s->second, x = work_.halves[h].prev, y = work_.halves[x].twin;
    const std::uint32_t to = work_.target(h), from = work_.halves[x].point;
    if (!((to == ahead && from == back) || (to == back && from == ahead))) { return false; }
    if (work_.halves[y].prev != work_.halves[h].twin) { return false; }
  }
  const Predicates& p = work_.predicates;
  const WorkHalf& half = work_.halves[first];
  const PlaneNumber plane = work_.faces[half.face].plane.number();
  const Point& point = work_.points[back];
  if (p.side(point, half.across) != 0 || p.side(point, plane) != 0) { return false; }
  const Line line(p.plane(plane), p.plane(half.across));
  const int order = p.compare(point, work_.points[half.point], line.axis);
  return order != 0 && order == p.compare(work_.points[half.point], work_.points[ahead], line.axis);
}

}  // namespace brep::csg::detail
