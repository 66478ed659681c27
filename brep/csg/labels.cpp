// SPDX-License-Identifier: MIT
#include <brep/csg/labels.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/point_in_solid.hpp>
#include <brep/csg/point_table.hpp>
#include <brep/csg/radial.hpp>
#include <brep/csg/solid.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE void Labels::run(const Radial& radial) {
  known_.assign(work_.faces.size(), 0);
  sides.assign(work_.faces.size(), Side::outside);
  waiting_.reserve(work_.faces.size());
  common_.assign(work_.halves.size(), 0);
  for (const Spine& s : radial.spines) {
    common_[s.half] = 1;
    give(work_.halves[s.half].face, s.side);
  }
  spread();
  Box boxes[2];
  for (const WorkFace& f : work_.faces) { boxes[f.of_b].add(f.box); }
  for (std::uint32_t f = 0; f < work_.faces.size() && fault == invalid_index; ++f) {
    if (known_[f]) { continue; }
    give(f, boxes[!work_.faces[f].of_b].meets(boxes[work_.faces[f].of_b]) ? ask(f) : far(!work_.faces[f].of_b));
    spread();
  }
}

HALFLIGHT_INLINE void Labels::give(std::uint32_t f, Side side) {
  if (known_[f]) {
    if (sides[f] != side) { fault = f; }
    return;
  }
  known_[f] = 1;
  sides[f] = side;
  waiting_.push_back(f);
}

HALFLIGHT_INLINE void Labels::spread() {
  for (; next_ < waiting_.size(); ++next_) {
    const std::uint32_t f = waiting_[next_];
    const WorkFace& face = work_.faces[f];
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const std::uint32_t h = work_.half(face, i);
      if (!common_[h]) { give(work_.halves[work_.halves[h].twin].face, sides[f]); }
    }
  }
}

HALFLIGHT_INLINE Side Labels::ask(std::uint32_t f) {
  const bool other = !work_.faces[f].of_b;
  const PointInSolid inside(work_, other);
  std::vector<std::uint32_t> part{f};
  known_[f] = 1;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const WorkFace& face = work_.faces[part[k]];
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const std::uint32_t h = work_.half(face, i), next = work_.halves[work_.halves[h].twin].face;
      if (!common_[h] && !known_[next]) { known_[next] = 1, part.push_back(next); }
    }
  }
  for (std::uint32_t x : part) { known_[x] = 0; }
  int answer = 0;
  for (int attempt = 0; attempt < 2 && answer == 0; ++attempt) {
    for (std::size_t k = 0; k < part.size() && answer == 0; ++k) {
      const WorkFace& face = work_.faces[part[k]];
      for (std::uint32_t i = 0; i < face.count && answer == 0; ++i) {
        const std::uint32_t h = work_.half(face, i), v = work_.halves[h].point;
        if (attempt == 0 && !contacts_.contains(v)) { answer = inside(inside.vertex(v)); }
        if (attempt == 1) { answer = inside(inside.middle(v, work_.target(h))); }
      }
    }
  }
  if (answer == 0) { fault = f; }
  return (answer > 0) != (other && b_reversed_) ? Side::inside : Side::outside;
}

}  // namespace brep::csg::detail
