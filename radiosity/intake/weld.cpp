// SPDX-License-Identifier: MIT
#include <radiosity/intake/weld.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>

#include <radiosity/scene/material.hpp>

namespace radiosity::intake {
namespace detail {

// Points in a grid of cells. A cell is much wider than the tolerance, so a query searches its own cell, and a neighbour only near the
// border. Points far outside the bounds share the outermost cells.
class PointGrid {
 public:
  PointGrid(const raycast::Box& bounds, double tolerance, std::vector<glm::dvec3>& points)
      : points_(points), origin_(bounds.lo), tolerance_(tolerance), cell_(std::max(64.0 * tolerance, bounds.diameter() * 0x1p-20)) {}

  // The first kept point within the tolerance, or `none`.
  [[nodiscard]] std::uint32_t find(const glm::dvec3& p) const {
    const glm::dvec3 lo = cell_of(p - tolerance_), hi = cell_of(p + tolerance_);
    std::uint32_t found = none;
    for (double x = lo.x; x <= hi.x; x += 1.0) {
      for (double y = lo.y; y <= hi.y; y += 1.0) {
        for (double z = lo.z; z <= hi.z; z += 1.0) {
          const auto head = heads_.find(key({x, y, z}));
          if (head == heads_.end()) { continue; }
          for (std::uint32_t i = head->second; i != none; i = next_[i]) {
            if (glm::length(points_[i] - p) <= tolerance_) { found = std::min(found, i); }
          }
        }
      }
    }
    return found;
  }
  std::uint32_t add(const glm::dvec3& p) {
    const auto index = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    const auto [head, is_new] = heads_.emplace(key(cell_of(p)), index);
    next_.push_back(is_new ? none : head->second);
    head->second = index;
    return index;
  }
  void reserve(std::size_t count) {
    heads_.reserve(count);
    next_.reserve(count);
    points_.reserve(count);
  }

 private:
  // Cells are numbered from -1 to 2^20 in each direction.
  [[nodiscard]] glm::dvec3 cell_of(const glm::dvec3& p) const { return glm::clamp(glm::floor((p - origin_) / cell_), -1.0, 0x1p20); }
  static std::uint64_t key(const glm::dvec3& cell) {
    const auto number = [](double x) { return static_cast<std::uint64_t>(x + 1.0); };
    return number(cell.x) << 42U | number(cell.y) << 21U | number(cell.z);
  }

  std::vector<glm::dvec3>& points_;
  std::unordered_map<std::uint64_t, std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
  glm::dvec3 origin_;
  double tolerance_, cell_;
};

// Do all indices exist, and are all coordinates finite?
inline bool usable_polygon(const PolygonView& input, std::size_t p, std::size_t materials) {
  if (input.first_corner[p] > input.first_corner[p + 1] || input.first_corner[p + 1] > input.corners.size()) { return false; }
  if (p >= input.material.size() || input.material[p] >= materials) { return false; }
  if (!input.group.empty() && p >= input.group.size()) { return false; }
  for (std::size_t i = input.first_corner[p]; i < input.first_corner[p + 1]; ++i) {
    if (input.corners[i] >= input.positions.size() || !raycast::usable(input.positions[input.corners[i]])) { return false; }
  }
  return true;
}

}  // namespace detail

HALFLIGHT_INLINE void weld(const PolygonView& input, std::span<const Material> materials, double relative_tolerance, Working& out) {
  std::vector<bool> usable(input.count());
  raycast::Box all, without_lamps;
  for (std::size_t p = 0; p < input.count(); ++p) {
    usable[p] = detail::usable_polygon(input, p, materials.size());
    if (!usable[p]) {
      out.changed(ChangeKind::unusable, static_cast<std::uint32_t>(p));
      continue;
    }
    const bool shines = !is_black(materials[input.material[p]].emission);
    for (std::size_t i = input.first_corner[p]; i < input.first_corner[p + 1]; ++i) {
      all.extend(input.positions[input.corners[i]]);
      if (!shines) { without_lamps.extend(input.positions[input.corners[i]]); }
    }
  }
  const raycast::Box& bounds = without_lamps.diameter() > 0.0 ? without_lamps : all;
  if (!(bounds.diameter() > 0.0)) { return; }
  out.tolerance = relative_tolerance * bounds.diameter() + 0x1p-50 * bounds.magnitude();  // rounding error of the coordinates
  detail::PointGrid grid(bounds, out.tolerance, out.positions);
  grid.reserve(input.positions.size());
  std::vector<std::uint32_t> kept(input.positions.size(), none);
  for (std::size_t p = 0; p < input.count(); ++p) {
    if (!usable[p]) { continue; }
    Face face{{}, input.material[p], input.group.empty() ? 0 : input.group[p], static_cast<std::uint32_t>(p)};
    for (std::size_t i = input.first_corner[p]; i < input.first_corner[p + 1]; ++i) {
      const std::uint32_t v = input.corners[i];
      if (kept[v] == none) {
        const glm::dvec3& position = input.positions[v];
        kept[v] = grid.find(position);
        if (kept[v] == none) {
          kept[v] = grid.add(position);
        } else {
          out.changed(ChangeKind::welded, face.polygon, glm::length(out.positions[kept[v]] - position));
        }
      }
      face.corners.push_back(kept[v]);
    }
    out.faces.push_back(std::move(face));
  }
}

}  // namespace radiosity::intake
