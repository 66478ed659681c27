// SPDX-License-Identifier: MIT
#pragma once

// Which points of an operation are the same? Each contact of the operands is looked up here and gets one number.
//
// Equal points have bit-equal rounded coordinates (predicates.hpp), so a hash of these finds the candidate, and exact equality decides.
// Vertices of the operands enter when they take part in a contact; one that equals a point met before is renamed.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/csg/boundary.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>

namespace brep::csg::detail {

class PointTable {
 public:
  explicit PointTable(Work& work) : work_(work), name_(work.points.size(), invalid_index) { slots_.assign(256, invalid_index); }

  // The number of a vertex of the operands.
  std::uint32_t of_vertex(std::uint32_t v);
  // The number of a point, which is added to the points of the operation if it is new.
  std::uint32_t of(const Point& p);

  // Is the point part of a contact?
  [[nodiscard]] bool contains(std::uint32_t p) const { return name_[p] != invalid_index; }
  [[nodiscard]] std::uint32_t name(std::uint32_t p) const { return name_[p] == invalid_index ? p : name_[p]; }
  // All points of contact.
  [[nodiscard]] const std::vector<std::uint32_t>& points() const { return points_; }
  [[nodiscard]] bool renamed() const { return renamed_; }

 private:
  static std::uint64_t hash(const glm::dvec3& p);
  std::uint32_t& find(const Point& p);
  void entered(std::uint32_t number);

  Work& work_;
  std::vector<std::uint32_t> name_, slots_, points_;
  bool renamed_ = false;
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/point_table.cpp>
#endif
