// SPDX-License-Identifier: MIT
#pragma once

// Finds, without a mesh, boxes that contain the solid of a CSG tree, and boxes outside of which a leaf has no influence on it.
//
// A cell of space is outside a leaf, inside it, or unknown. If the distance of its centre from all sheets is more than the radius of the
// cell, no surface passes through it. The values of the leaves give those of the nodes (three-valued logic). A grid of cells is laid over
// the bounds, cells that are certainly outside are dropped, and the next grid is laid over the rest; a lens in which two large spheres
// just overlap is found in about ten rounds. Dropped cells are certainly outside, so an empty region proves that the solid is empty.

#include <cstdint>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/objects/csg_tree.hpp>

namespace raycast {

struct CsgRegion {
  Box whole;                // contains the solid; empty if there is none
  std::vector<Box> leaves;  // within `whole`, the surface of a leaf takes part in the solid only in its box; empty: nowhere
};

namespace detail {

class CsgRegions {
 public:
  explicit CsgRegions(const CsgTree& tree);

  [[nodiscard]] CsgRegion run() const;

  enum class Where : std::uint8_t { outside, inside, unknown };

  // The state of all points of the box.
  [[nodiscard]] Where where(std::uint32_t leaf, const Box& cell) const;

 private:
  static constexpr std::uint32_t most_sheets = 64;  // for a mesh with more sheets it does not pay to test them all
  static constexpr int cells = 8;

  // One round: the region within the box.
  [[nodiscard]] CsgRegion inside(const Box& box) const;

  // Nodes come before their parts.
  [[nodiscard]] Where of_tree(const std::vector<Where>& of_leaf, std::vector<Where>& of_node) const;

  const CsgTree& tree_;
  std::vector<double> shrink_;  // by leaf: the factor of a distance given by project() that is a certain lower bound; 0: none
};

}  // namespace detail

[[nodiscard]] inline CsgRegion csg_region(const CsgTree& tree) { return detail::CsgRegions(tree).run(); }

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_region.cpp>
#endif
