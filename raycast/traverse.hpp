// SPDX-License-Identifier: MIT
#pragma once

// A walk in double precision along a line through a Bvh. What lies in the leaves is the caller's business: it is a lambda. No box that the
// line meets is missed (box.hpp), and the heap is not touched.

#include <array>
#include <cstddef>
#include <cstdint>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>

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

}  // namespace raycast
