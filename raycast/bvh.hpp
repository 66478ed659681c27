// SPDX-License-Identifier: MIT
#pragma once

// A bounding volume hierarchy over boxes: binary, built by the surface area heuristic over 16 bins per axis (Wald 2007), in one flat
// array. The two children of a node are neighbours, the one of larger area first: any-hit searches look there first.
//
// The boxes must already be grown by the rounding of what lies inside; the tree adds nothing to them. traverse.hpp walks it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <raycast/box.hpp>

namespace raycast {

class Bvh {
 public:
  static constexpr std::uint32_t depth_limit = 88;  // of any tree: heuristic splits to depth 56, then halves (2^32 items at most)

  struct Node {
    Box box;
    std::uint32_t first;  // leaf: items first .. first + count; inner node: children first and first + 1
    std::uint32_t count;  // 0 for an inner node
  };

  Bvh() = default;

  // item_cost: the cost of testing one item relative to that of one box.
  explicit Bvh(std::span<const Box> boxes, double item_cost = 1.0);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] std::span<const std::uint32_t> items(const Node& leaf) const {
    return std::span<const std::uint32_t>(items_).subspan(leaf.first, leaf.count);
  }
  [[nodiscard]] std::size_t bytes() const { return nodes_.capacity() * sizeof(Node) + items_.capacity() * sizeof(std::uint32_t); }

 private:
  static constexpr std::size_t bin_count = 16;
  struct Bin {
    Box box;
    std::uint32_t count = 0;
  };

  static std::size_t bin_of(const Box& box, const Box& centres, int axis);

  // Turns a leaf into an inner node with two leaves, unless testing all its items is expected to be cheaper.
  bool split(std::uint32_t index, std::uint32_t depth, std::span<const Box> boxes, double item_cost);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/bvh.cpp>
#endif
