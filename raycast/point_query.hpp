// SPDX-License-Identifier: MIT
#pragma once

// Searches of a Bvh from a point: what lies around it, and what is nearest to it. The caller defines the items. Both searches are exact
// with respect to the boxes from which the tree was built.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/walk.hpp>

namespace raycast {

// Calls visit(item) -> bool for the items of every leaf for which wanted(box) holds for its box and the boxes of all its ancestors, until
// visit returns true.
template <class Wanted, class Visit>
bool any_within(const Bvh& bvh, Wanted&& wanted, Visit&& visit) {
  if (bvh.empty()) { return false; }
  struct Open {
    std::uint32_t child;
  };
  const Bvh::Node* const nodes = bvh.nodes().data();
  const auto leaf = [&](const Open& at) {
    for (const std::uint32_t item : bvh.items(nodes[at.child])) {
      if (visit(item)) { return true; }
    }
    return false;
  };
  const auto inner = [&](const Open& at, auto& put_off) {
    put_off.push({nodes[at.child].first + 1});
    put_off.push({nodes[at.child].first});
    return false;
  };
  return portable::walk(
      bvh, Open{0}, [&](const Open& at) { return wanted(nodes[at.child].box); }, leaf, inner);
}

// Calls visit(item) for the items of every leaf whose box contains p (border included): for all items whose own box contains p, and
// possibly more.
template <class Visit>
void around(const Bvh& bvh, const glm::dvec3& p, Visit&& visit) {
  any_within(
      bvh, [&](const Box& box) { return box.contains(p); }, [&](std::uint32_t item) { return visit(item), false; });
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

// The item nearest to p; nothing in an empty tree. squared(item): squared distance of an item from p; every item must lie within its box.
// Of equally distant items, the first one found.
template <class Squared>
[[nodiscard]] std::optional<std::uint32_t> nearest(const Bvh& bvh, const glm::dvec3& p, Squared&& squared) {
  if (bvh.empty()) { return std::nullopt; }
  struct Open {
    std::uint32_t child;
    double squared;
  };
  const Bvh::Node* const nodes = bvh.nodes().data();
  std::optional<std::uint32_t> best;
  double best_squared = infinity;
  const auto near = [&](const Open& at) { return !(best && at.squared >= best_squared); };
  const auto leaf = [&](const Open& at) {
    for (const std::uint32_t item : bvh.items(nodes[at.child])) {
      const double distance = squared(item);
      if (best && !(distance < best_squared)) { continue; }
      best = item;
      best_squared = distance;
    }
    return false;
  };
  const auto inner = [&](Open& at, auto& put_off) {
    const std::uint32_t first = nodes[at.child].first;
    Open other{first + 1, squared_distance(nodes[first + 1].box, p)};
    at = {first, squared_distance(nodes[first].box, p)};
    if (other.squared < at.squared) { std::swap(at, other); }
    put_off.push(other);
    put_off.push(at);
    return false;
  };
  portable::walk(bvh, Open{0, 0.0}, near, leaf, inner);
  return best;
}

}  // namespace raycast
