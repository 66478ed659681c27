// SPDX-License-Identifier: MIT
#pragma once

// A bounding volume hierarchy over boxes in double precision: binary, in one flat array (bvh_builder.hpp). line_query.hpp and
// point_query.hpp search it.
//
// The boxes must include the rounding error of their items; the tree does not enlarge them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/bvh_builder.hpp>

namespace raycast {

class Bvh {
 public:
  using Node = BinaryNode<Box>;
  static constexpr std::size_t fan_out = 2;

  Bvh() = default;

  // item_cost: the cost of testing one item relative to that of one box.
  explicit Bvh(std::span<const Box> boxes, double item_cost = 1.0);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] bool is_leaf(std::uint32_t node) const { return nodes_[node].count > 0; }
  [[nodiscard]] std::span<const std::uint32_t> items(const Node& leaf) const {
    return std::span<const std::uint32_t>(items_).subspan(leaf.first, leaf.count);
  }
  [[nodiscard]] std::size_t bytes() const { return nodes_.capacity() * sizeof(Node) + items_.capacity() * sizeof(std::uint32_t); }

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/bvh.cpp>
#endif
