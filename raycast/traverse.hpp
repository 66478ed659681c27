// SPDX-License-Identifier: MIT
#pragma once

// Walks through a Bvh along a line. What lies in the leaves is the caller's business: it is a lambda.
// Neither walk misses a box that the line meets (box.hpp), and neither touches the heap.

#include "bvh.hpp"

namespace raycast {

// Calls visit(item) -> bool for the items whose leaf the line meets within [t0, t1], in no particular order, until one returns true.
template <class Visit>
[[nodiscard]] bool any(const Bvh& bvh, const SlabTest& slabs, double t0, double t1, Visit&& visit) {
  if (bvh.empty()) return false;
  const Bvh::Node* const nodes = bvh.nodes().data();
  std::array<std::uint32_t, Bvh::depth_limit + 2> stack;
  std::size_t top = 0;
  double entry = 0.0;
  if (slabs(nodes[0].box, t0, t1, entry)) stack[top++] = 0;
  while (top > 0) {
    const Bvh::Node& node = nodes[stack[--top]];
    if (node.count > 0) {
      for (const std::uint32_t item : bvh.items(node))
        if (visit(item)) return true;
      continue;
    }
    if (slabs(nodes[node.first + 1].box, t0, t1, entry)) stack[top++] = node.first + 1;
    if (slabs(nodes[node.first].box, t0, t1, entry)) stack[top++] = node.first;  // the larger one is looked at next
  }
  return false;
}

// Calls visit(item) for the items whose leaf the line meets within [t0, limit], nearer leaves first. visit may lower `limit`.
template <class Visit>
void closest(const Bvh& bvh, const SlabTest& slabs, double t0, const double& limit, Visit&& visit) {
  if (bvh.empty()) return;
  struct Entry {
    std::uint32_t node;
    double t;
  };
  const Bvh::Node* const nodes = bvh.nodes().data();
  std::array<Entry, Bvh::depth_limit + 2> stack;
  std::size_t top = 0;
  double left = 0.0, right = 0.0;
  if (slabs(nodes[0].box, t0, limit, left)) stack[top++] = {0, left};
  while (top > 0) {
    const Entry at = stack[--top];
    if (at.t > limit) continue;
    const Bvh::Node& node = nodes[at.node];
    if (node.count > 0) {
      for (const std::uint32_t item : bvh.items(node)) visit(item);
      continue;
    }
    const bool meets_left = slabs(nodes[node.first].box, t0, limit, left);
    const bool meets_right = slabs(nodes[node.first + 1].box, t0, limit, right);
    const bool left_first = left <= right;
    if (meets_right && left_first) stack[top++] = {node.first + 1, right};
    if (meets_left) stack[top++] = {node.first, left};
    if (meets_right && !left_first) stack[top++] = {node.first + 1, right};
  }
}

}  // namespace raycast
