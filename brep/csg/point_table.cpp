// SPDX-License-Identifier: MIT
#include <brep/csg/point_table.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/csg/boundary.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE std::uint32_t PointTable::of_vertex(std::uint32_t v) {
  if (name_[v] == invalid_index) {
    std::uint32_t& slot = find(work_.points[v]);
    if (slot == invalid_index) {
      name_[v] = slot = v;
      entered(v);
    } else {
      name_[v] = slot;
      renamed_ = true;
    }
  }
  return name_[v];
}

HALFLIGHT_INLINE std::uint32_t PointTable::of(const Point& p) {
  std::uint32_t& slot = find(p);
  if (slot != invalid_index) { return slot; }
  const auto number = slot = static_cast<std::uint32_t>(work_.points.size());
  work_.points.push_back(p);
  name_.push_back(number);
  entered(number);
  return number;
}

HALFLIGHT_INLINE std::uint64_t PointTable::hash(const glm::dvec3& p) {
  std::uint64_t h = 0;
  for (int i = 0; i < 3; ++i) { h = (h ^ (h >> 29) ^ std::bit_cast<std::uint64_t>(p[i] + 0.0)) * 0x9e3779b97f4a7c15u; }
  return h ^ (h >> 32);
}

HALFLIGHT_INLINE std::uint32_t& PointTable::find(const Point& p) {
  std::size_t i = hash(p.position) & (slots_.size() - 1);
  while (slots_[i] != invalid_index && !work_.predicates.equal(work_.points[slots_[i]], p)) { i = (i + 1) & (slots_.size() - 1); }
  return slots_[i];
}

HALFLIGHT_INLINE void PointTable::entered(std::uint32_t number) {
  points_.push_back(number);
  if (2 * points_.size() < slots_.size()) { return; }
  std::vector<std::uint32_t> old(2 * slots_.size(), invalid_index);
  old.swap(slots_);
  for (std::uint32_t p : old) {
    if (p == invalid_index) { continue; }
    std::size_t i = hash(work_.points[p].position) & (slots_.size() - 1);
    while (slots_[i] != invalid_index) { i = (i + 1) & (slots_.size() - 1); }
    slots_[i] = p;
  }
}

}  // namespace brep::csg::detail
