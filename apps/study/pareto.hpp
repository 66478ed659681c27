// SPDX-License-Identifier: MIT
#pragma once

// The Pareto front of cost against error: the points that no other point beats. A point is beaten by one that costs no more and errs
// no more, and less in one of the two; of equal points the first stays. Along the front cost rises and error falls, strictly.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "apps/study/slope.hpp"

namespace study {

// Indices of the points on the front, cheapest first. Points that cannot be drawn are never on it.
[[nodiscard]] inline std::vector<std::size_t> pareto_front(const std::vector<CostPoint>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (drawable(points[i])) { order.push_back(i); }
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (front.empty() || points[i].error < points[front.back()].error) { front.push_back(i); }
  }
  return front;
}

}  // namespace study
