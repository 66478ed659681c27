// SPDX-License-Identifier: MIT
#pragma once

// Walks through a Bvh from a point: what lies around it, and what lies nearest to it. What the items are is the caller's business.
// Both walks are exact in terms of the boxes that the tree was built from, and neither touches the heap.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>

namespace raycast {

// Calls visit(item) for the items of every leaf whose box contains p, faces included: for all items whose own box contains p, and
// possibly more.
template <class Visit>
void around(const Bvh& bvh, const glm::dvec3& p, Visit&& visit) {
  if (bvh.empty()) return;
  const Bvh::Node* const nodes = bvh.nodes().data();
  std::array<std::uint32_t, Bvh::depth_limit + 2> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Bvh::Node& node = nodes[stack[--top]];
    if (!node.box.contains(p)) continue;
    if (node.count > 0) {
      for (const std::uint32_t item : bvh.items(node)) visit(item);
      continue;
    }
    stack[top++] = node.first + 1;
    stack[top++] = node.first;
  }
}

// The squared distance from p to the box; 0 inside.
[[nodiscard]] inline double squared_distance(const Box& box, const glm::dvec3& p) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double outside = std::max({box.lo[k] - p[k], p[k] - box.hi[k], 0.0});
    sum += outside * outside;
  }
  return sum;
}

// The item nearest to p; nothing in an empty tree. squared(item) is the squared distance of an item from p, and no item reaches out
// of its box. Of items equally far, the one that is met first.
template <class Squared>
[[nodiscard]] std::optional<std::uint32_t> nearest(const Bvh& bvh, const glm::dvec3& p, Squared&& squared) {
  if (bvh.empty()) return std::nullopt;
  struct Entry {
    std::uint32_t node;
    double squared;
  };
  const Bvh::Node* const nodes = bvh.nodes().data();
  std::array<Entry, Bvh::depth_limit + 2> stack;
  std::size_t top = 0;
  stack[top++] = {0, squared_distance(nodes[0].box, p)};
  std::optional<std::uint32_t> best;
  double best_squared = infinity;
  while (top > 0) {
    const Entry at = stack[--top];
    if (best && at.squared >= best_squared) continue;
    const Bvh::Node& node = nodes[at.node];
    if (node.count > 0) {
      for (const std::uint32_t item : bvh.items(node)) {
        const double distance = squared(item);
        if (best && !(distance < best_squared)) continue;
        best = item;
        best_squared = distance;
      }
      continue;
    }
    Entry near{node.first, squared_distance(nodes[node.first].box, p)};
    Entry far{node.first + 1, squared_distance(nodes[node.first + 1].box, p)};
    if (far.squared < near.squared) std::swap(near, far);
    stack[top++] = far;
    stack[top++] = near;
  }
  return best;
}

}  // namespace raycast
