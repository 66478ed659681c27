// SPDX-License-Identifier: MIT
#pragma once

// Where a CSG tree can have its solid, and where each leaf can matter: boxes that are found without a mesh.
//
// A cell of space is outside of a leaf, inside of it, or not known to be either. The distance from its middle to the sheets decides: where
// it is more than the radius of the cell, no surface passes through. From the leaves follow the nodes of the tree (an interval of truth
// values). A grid of cells is laid over the bounds, those that are outside for certain are dropped, and a grid over the rest comes next; so
// a lens in which two large spheres just meet is found in some ten rounds. What is dropped is certainly outside, so an empty region is a
// proof.

#include <cstdint>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/objects/csg_tree.hpp>

namespace raycast {

struct CsgRegion {
  Box whole;                // no part of the solid lies outside; empty: there is none
  std::vector<Box> leaves;  // within it no surface of the leaf takes part in the solid outside of this box; empty: nowhere
};

namespace detail {

class CsgRegions {
 public:
  explicit CsgRegions(const CsgTree& tree);

  [[nodiscard]] CsgRegion run() const;

  enum class Where : std::uint8_t { outside, inside, unknown };

  // Of all points of the box.
  [[nodiscard]] Where where(std::uint32_t leaf, const Box& cell) const;

 private:
  static constexpr std::uint32_t most_sheets = 64;  // of a mesh with more it is not worth while to look at all
  static constexpr int cells = 8;

  // One round.
  [[nodiscard]] CsgRegion inside(const Box& box) const;

  // Parts stand behind their node.
  [[nodiscard]] Where of_tree(const std::vector<Where>& of_leaf, std::vector<Where>& of_node) const;

  const CsgTree& tree_;
  std::vector<double> shrink_;  // of each leaf: what of a distance by project() is certain
};

}  // namespace detail

[[nodiscard]] inline CsgRegion csg_region(const CsgTree& tree) { return detail::CsgRegions(tree).run(); }

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_region.cpp>
#endif
