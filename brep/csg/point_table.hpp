// SPDX-License-Identifier: MIT
#pragma once

// Which points of an operation are the same? Each contact of the operands is looked up here and gets one number.
//
// Equal points have bit-equal rounded coordinates (predicates.hpp), so a hash of these finds the candidate, and exact equality decides.
// Vertices of the operands enter when they take part in a contact; one that equals a point met before is renamed.

#include <bit>
#include <cstdint>
#include <vector>

#include <brep/csg/work.hpp>

namespace brep::csg::detail {

class PointTable {
 public:
  explicit PointTable(Work& work) : work_(work), name_(work.points.size(), invalid_index) { slots_.assign(256, invalid_index); }

  // The number of a vertex of the operands.
  std::uint32_t of_vertex(std::uint32_t v) {
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
  // The number of a point, which is added to the points of the operation if it is new.
  std::uint32_t of(const Point& p) {
    std::uint32_t& slot = find(p);
    if (slot != invalid_index) { return slot; }
    const auto number = slot = static_cast<std::uint32_t>(work_.points.size());
    work_.points.push_back(p);
    name_.push_back(number);
    entered(number);
    return number;
  }

  // Is the point part of a contact?
  [[nodiscard]] bool contains(std::uint32_t p) const { return name_[p] != invalid_index; }
  [[nodiscard]] std::uint32_t name(std::uint32_t p) const { return name_[p] == invalid_index ? p : name_[p]; }
  // All points of contact.
  [[nodiscard]] const std::vector<std::uint32_t>& points() const { return points_; }
  [[nodiscard]] bool renamed() const { return renamed_; }

 private:
  static std::uint64_t hash(const glm::dvec3& p) {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) { h = (h ^ (h >> 29) ^ std::bit_cast<std::uint64_t>(p[i] + 0.0)) * 0x9e3779b97f4a7c15u; }
    return h ^ (h >> 32);
  }
  std::uint32_t& find(const Point& p) {
    std::size_t i = hash(p.position) & (slots_.size() - 1);
    while (slots_[i] != invalid_index && !work_.predicates.equal(work_.points[slots_[i]], p)) { i = (i + 1) & (slots_.size() - 1); }
    return slots_[i];
  }
  void entered(std::uint32_t number) {
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

  Work& work_;
  std::vector<std::uint32_t> name_, slots_, points_;
  bool renamed_ = false;
};

}  // namespace brep::csg::detail
