// SPDX-License-Identifier: MIT
#pragma once

// Sets of numbers that are merged step by step: faces that hang together, rooms that light joins.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace brep::detail {

// Sets that are merged (Tarjan 1975, with path halving); the smallest member represents a set.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  [[nodiscard]] std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) { x = parent_[x] = parent_[parent_[x]]; }
    return x;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace brep::detail
