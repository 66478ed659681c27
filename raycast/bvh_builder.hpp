// SPDX-License-Identifier: MIT
#pragma once

// The builder of all trees in raycast/: binary, top down, by the surface area heuristic over 16 bins of the centres per axis (Wald 2007).
// bvh.cpp uses the tree as it is, in double precision; wide_tree.hpp collapses one in single precision to nodes of eight children.
//
// The two children of a node are adjacent, the one with the larger area first, because any-hit searches visit it first. Children come
// after their parent in the array of nodes.
//
// Depth. The heuristic alone could make a chain of any length, so below level 56 a node is halved by number: 2^32 items become eight
// after 29 halvings, and eight items become single items, or items of one kind, after at most 7 more levels.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace raycast {

inline constexpr std::uint32_t heuristic_depth = 56, tree_depth_limit = heuristic_depth + 29 + 7;
inline constexpr std::size_t bin_count = 16;

template <class Bounds>
struct BinaryNode {
  Bounds box;
  std::uint32_t first;  // leaf: references first .. first + count; inner node: children first and first + 1
  std::uint32_t count;  // 0 for an inner node
};

// Policy defines the precision, and when a node is a leaf:
//   Real, Bounds           Bounds: extend(Bounds), half_area() -> Real
//   Grid                   made from the centres of some references: position(box)[axis], and position(box, axis) for one axis, is the
//                          position of a box's centre in [0, bin_count]; wide(axis): do the centres differ along this axis?
//   cost(n)                of testing n items, relative to a test of one box
//   few                    up to this many references are not divided by the heuristic but by
//   divide(begin, end)     -> where the second part begins; end: they are a leaf
//   leaf(area, n, best)    is testing n > few items cheaper than dividing the node, whose children would cost `best`?
template <class Policy>
class BvhBuilder {
 public:
  using Real = typename Policy::Real;
  using Bounds = typename Policy::Bounds;
  using Node = BinaryNode<Bounds>;
  struct Reference {
    Bounds box;
    std::uint32_t item;
  };

  explicit BvhBuilder(Policy policy) : policy_(std::move(policy)) {}

  std::vector<Reference> references;  // filled in by the caller; build() sorts them so that those of a leaf are adjacent
  std::vector<Node> nodes;            // the root comes first; empty without references

  void build() {
    if (references.empty()) { return; }
    const auto count = static_cast<std::uint32_t>(references.size());
    nodes.reserve(references.size());
    nodes.push_back(node(0, count));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> todo{{0, 0}};  // node, depth
    while (!todo.empty()) {
      const auto [at, depth] = todo.back();
      todo.pop_back();
      if (!split(at, depth)) { continue; }
      todo.push_back({nodes[at].first, depth + 1});
      todo.push_back({nodes[at].first + 1, depth + 1});
    }
  }

 private:
  struct Bin {
    Bounds box;
    std::uint32_t count = 0;
  };
  struct Cut {  // between bins bin - 1 and bin of an axis
    Real cost = std::numeric_limits<Real>::infinity();
    int axis = -1;
    std::size_t bin = 0;
  };

  [[nodiscard]] Node node(std::uint32_t first, std::uint32_t count) const {
    Bounds box;
    for (std::uint32_t i = first; i < first + count; ++i) { box.extend(references[i].box); }
    return {box, first, count};
  }
  static std::size_t bin_of(Real position) {
    return std::min(static_cast<std::size_t>(std::max(static_cast<std::int32_t>(position), 0)), bin_count - 1);
  }

  // The cheapest of 45 cuts; axis -1 if all centres are equal.
  [[nodiscard]] Cut best_cut(std::span<const Reference> part, const typename Policy::Grid& grid) const {
    std::array<std::array<Bin, bin_count>, 3> bins{};
    for (const Reference& reference : part) {
      const auto position = grid.position(reference.box);
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[static_cast<std::size_t>(axis)][bin_of(position[axis])];
        bin.box.extend(reference.box);
        ++bin.count;
      }
    }
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!grid.wide(axis)) { continue; }
      const std::array<Bin, bin_count>& row = bins[static_cast<std::size_t>(axis)];
      std::array<Real, bin_count> above{};  // cost of bins k, k+1, ...
      Bin sum;
      for (std::size_t k = bin_count; k-- > 1;) {
        sum.box.extend(row[k].box);
        sum.count += row[k].count;
        above[k] = sum.box.half_area() * policy_.cost(sum.count);
      }
      sum = Bin{};
      for (std::size_t k = 1; k < bin_count; ++k) {
        sum.box.extend(row[k - 1].box);
        sum.count += row[k - 1].count;
        const Real cost = sum.box.half_area() * policy_.cost(sum.count) + above[k];
        if (sum.count && sum.count < part.size() && cost < best.cost) { best = {cost, axis, k}; }
      }
    }
    return best;
  }

  // Turns a leaf into an inner node with two leaves; returns false if it stays a leaf.
  bool split(std::uint32_t at, std::uint32_t depth) {
    const Node whole = nodes[at];
    const auto begin = references.begin() + whole.first, end = begin + whole.count;
    auto middle = end;
    if (whole.count <= Policy::few) {
      middle = policy_.divide(begin, end);
      if (middle == end) { return false; }
    } else {
      const typename Policy::Grid grid{std::span<const Reference>(begin, end)};
      const Cut cut = depth < heuristic_depth ? best_cut({begin, end}, grid) : Cut{};
      if (policy_.leaf(whole.box.half_area(), whole.count, cut.cost)) { return false; }
      middle = begin + whole.count / 2;  // equal centres, or too deep
      if (cut.axis >= 0) {
        middle = std::partition(begin, end, [&](const Reference& r) { return bin_of(grid.position(r.box, cut.axis)) < cut.bin; });
      }
    }
    const auto left_count = static_cast<std::uint32_t>(middle - begin);
    Node left = node(whole.first, left_count), right = node(whole.first + left_count, whole.count - left_count);
    if (left.box.half_area() < right.box.half_area()) { std::swap(left, right); }
    nodes[at].first = static_cast<std::uint32_t>(nodes.size());
    nodes[at].count = 0;
    nodes.push_back(left);
    nodes.push_back(right);
    return true;
  }

  Policy policy_;
};

}  // namespace raycast
