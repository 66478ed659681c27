// SPDX-License-Identifier: MIT
#pragma once

// Sets of numbers that are merged step by step: faces that hang together, rooms that light joins.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace brep::detail {

// The root of x in a forest that is stored as the parent of each member, where a root is its own parent. Halves the path on the way
// (Tarjan 1975).
[[nodiscard]] inline std::uint32_t find_root(std::vector<std::uint32_t>& parent, std::uint32_t x) {
  while (parent[x] != x) { x = parent[x] = parent[parent[x]]; }
  return x;
}

// Sets that are merged; the smallest member represents a set.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  [[nodiscard]] std::uint32_t find(std::uint32_t x) { return find_root(parent_, x); }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  // Numbers the sets from 0 in the order of their smallest members. Sets `number` of each member; returns how many sets there are.
  [[nodiscard]] std::uint32_t enumerate(std::vector<std::uint32_t>& number) {
    std::uint32_t count = 0;
    number.resize(parent_.size());
    for (std::uint32_t i = 0; i < parent_.size(); ++i) { number[i] = find(i) == i ? count++ : number[find(i)]; }
    return count;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace brep::detail
