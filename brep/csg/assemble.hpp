// SPDX-License-Identifier: MIT
#pragma once

// From the faces that are selected to the boundary of the result: regluing, merging, and leaving out what is no longer needed.
//
// Around a common edge the selected faces begin and end the result in turn; twins are the two that bound one solid wedge. So every result
// is a 2-manifold, whatever coincides: where solids touch along an edge, there are two edges. Then neighbours in one plane with equal
// attributes become one face (join_faces and cut, as links), and points between two edges on one line go (join_vertices).

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/csg/radial.hpp>
#include <brep/csg/work.hpp>
#include <brep/edge_uses.hpp>

namespace brep::csg::detail {

class Assemble {
 public:
  // keep: of each face. A kept half-edge whose twin is not kept must be glued anew.
  Assemble(Work& work, std::vector<std::uint8_t> keep)
      : work_(work), keep_(std::move(keep)), removed_(work.halves.size(), 0), groups_(work.faces.size()) {}

  // The half-edge is one of several at its place: its edge stays.
  void hold(std::uint32_t h) {
    removed_[h] = held;
    touching_ = true;
  }

  // Pairs the kept faces around each common edge; false: they do not begin and end in turn.
  [[nodiscard]] bool glue(const Radial& radial) {
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

  // Removes the edge of h if both its faces are kept, lie in one plane, look the same way, and have attributes of which same(i, j) holds.
  template <class Same>
  void merge(std::uint32_t h, Same&& same) {
    const std::uint32_t t = work_.halves[h].twin, f = work_.halves[h].face, g = work_.halves[t].face;
    if (removed_[h] != 0 || !keep_[f] || !keep_[g] || work_.faces[f].plane != work_.faces[g].plane) { return; }
    if (f != g && !same(work_.faces[f].attribute, work_.faces[g].attribute)) { return; }
    const std::uint32_t before_h = work_.halves[h].prev, after_h = work_.halves[h].next;
    const std::uint32_t before_t = work_.halves[t].prev, after_t = work_.halves[t].next;
    if (after_h != t) { work_.link(before_t, after_h); }
    if (after_t != h) { work_.link(before_h, after_t); }
    removed_[h] = removed_[t] = gone;
    groups_.unite(f, g);
  }

  // Removes the points for which candidate(point) holds and where two edges on one line meet and nothing else.
  template <class Candidate>
  void straighten(Candidate&& candidate) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> leaving;  // point, half-edge
    for (std::uint32_t f = 0; f < work_.faces.size(); ++f) {
      if (!keep_[f]) { continue; }
      const WorkFace& face = work_.faces[f];
      for (std::uint32_t i = 0; i < face.count; ++i) {
        const std::uint32_t h = work_.half(face, i);
        if (removed_[h] != gone && candidate(work_.halves[h].point)) { leaving.emplace_back(work_.halves[h].point, h); }
      }
    }
    std::sort(leaving.begin(), leaving.end());
    for (std::size_t first = 0, end = 0; first < leaving.size(); first = end) {
      while (end < leaving.size() && leaving[end].first == leaving[first].first) { ++end; }
      if (!straight(leaving.data() + first, leaving.data() + end)) { continue; }
      const std::uint32_t ahead = work_.target(leaving[first].second);
      for (std::size_t i = first; i < end; ++i) {
        const std::uint32_t h = leaving[i].second;
        if (work_.target(h) != ahead) { continue; }
        drop(h);
      }
    }
  }

  // The same umbrella by umbrella, whatever else meets the point.
  void straighten_umbrellas() {
    for (std::uint32_t h = 0; h < work_.halves.size(); ++h) {
      if (removed_[h] == gone || !keep_[work_.halves[h].face]) { continue; }
      const std::uint32_t x = work_.halves[h].prev, y = work_.halves[x].twin;
      const std::pair<std::uint32_t, std::uint32_t> pair[] = {{0, h}, {0, y}};
      if (y == h || work_.halves[y].prev != work_.halves[h].twin || !straight(pair, pair + 2)) { continue; }
      drop(h);
    }
  }

  [[nodiscard]] Boundary run() {
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

 private:
  [[nodiscard]] bool kept(std::uint32_t h) const { return keep_[work_.halves[h].face] != 0; }

  // Makes one edge of that of h and the one before it.
  void drop(std::uint32_t h) {
    const std::uint32_t x = work_.halves[h].prev, y = work_.halves[x].twin, t = work_.halves[h].twin;
    work_.link(x, work_.halves[h].next);
    work_.link(t, work_.halves[y].next);
    work_.halves[x].twin = t;
    work_.halves[t].twin = x;
    removed_[h] = removed_[y] = gone;
  }

  bool pair(const Spine& a, const Spine& b) {
    if (a.begins == b.begins) { return false; }
    if (a.begins) {
      work_.halves[a.half].twin = b.half;
      work_.halves[b.half].twin = a.half;
    }
    return true;
  }

  // Do the half-edges that leave a point run along two edges on one line, and each surface straight on?
  [[nodiscard]] bool straight(const std::pair<std::uint32_t, std::uint32_t>* begin,
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

  static constexpr std::uint8_t gone = 1, held = 2;

  Work& work_;
  bool touching_ = false;
  std::vector<std::uint8_t> keep_, removed_;
  brep::detail::UnionFind groups_;
};

// The boundary with faces as large as they can be, if that may be another one.
template <class Same>
[[nodiscard]] std::optional<Boundary> with_largest_faces(const PlaneTable& planes, const Boundary& boundary, Same&& same) {
  if (!boundary.touching) { return std::nullopt; }
  Work work(planes);
  work.add(boundary, false, false, 0);
  Assemble assemble(work, std::vector<std::uint8_t>(work.faces.size(), 1));
  for (std::uint32_t h = 0; h < work.halves.size(); ++h) { assemble.merge(h, same); }
  assemble.straighten_umbrellas();
  return assemble.run();
}

}  // namespace brep::csg::detail
