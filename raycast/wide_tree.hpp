// SPDX-License-Identifier: MIT
#pragma once

// Builds the tree of compiled.hpp: the binary tree of bvh_builder.hpp, collapsed into nodes of up to eight children in the cheapest
// possible way (after Wald, Benthin, Boulos 2008, with the optimal collapse by dynamic programming of Ylitie, Karras, Laine 2017). A leaf
// holds up to eight shapes of one kind, which are tested together: one costs as much as eight.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <raycast/bvh_builder.hpp>
#include <raycast/compile.hpp>
#include <raycast/compiled.hpp>
#include <raycast/kernels.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

namespace detail {

// Boxes as vectors of four numbers, for speed: the tree of a mesh is built while its user waits.
struct WidePolicy {
  using Real = float;
  using V = portable::F;
  struct Bounds {
    V lo = V{} + no_bound, hi = V{} - no_bound;
    void extend(const Bounds& b) { lo = portable::min(lo, b.lo), hi = portable::max(hi, b.hi); }
    [[nodiscard]] float half_area() const {
      const V s = hi - lo;
      return s[0] < 0.0f ? 0.0f : s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
    }
  };
  class Grid {
   public:
    template <class References>
    explicit Grid(const References& references) {
      Bounds centres;  // twice the centres
      for (const auto& reference : references) {
        const V c = reference.box.lo + reference.box.hi;
        centres.extend({c, c});
      }
      lo_ = centres.lo;
      const V width = centres.hi - centres.lo;
      for (int k = 0; k < 3; ++k) { scale_[k] = width[k] > 0.0f ? 0.999f * static_cast<float>(bin_count) / width[k] : 0.0f; }
    }
    [[nodiscard]] bool wide(int axis) const { return scale_[axis] > 0.0f; }
    [[nodiscard]] V position(const Bounds& box) const { return (box.lo + box.hi - lo_) * scale_; }
    [[nodiscard]] float position(const Bounds& box, int axis) const { return (box.lo[axis] + box.hi[axis] - lo_[axis]) * scale_[axis]; }

   private:
    V lo_{}, scale_{};
  };
  static constexpr std::uint32_t few = 8;

  const std::vector<Item>& items;

  [[nodiscard]] static float cost(std::uint32_t count) { return static_cast<float>((count + 7) / 8); }
  template <class Iterator>
  [[nodiscard]] Iterator divide(Iterator begin, Iterator end) const {  // divides by kind
    const Kind kind = items[begin->item].kind;
    return std::partition(begin, end, [&](const auto& reference) { return items[reference.item].kind == kind; });
  }
  [[nodiscard]] static bool leaf(float, std::uint32_t, float) { return false; }
};

}  // namespace detail

// Emit(kind, items) -> index of the first of them among its kind; called once for every leaf, in the order of the tree.
template <class Emit>
class WideTreeBuilder {
 public:
  WideTreeBuilder(std::vector<Item>& items, Emit emit) : items_(items), emit_(std::move(emit)) {}

  // Makes only leaves, each with its items, for scenes that need no tree.
  void leaves(std::vector<std::uint32_t>& out) {
    std::stable_sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) { return a.kind < b.kind; });
    for (std::size_t i = 0; i < items_.size();) {
      std::size_t end = i + 1;
      while (end < items_.size() && end < i + 8 && items_[end].kind == items_[i].kind) { ++end; }
      out.push_back(leaf({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(end - i)}));
      i = end;
    }
  }

  void build(std::vector<Node>& out) {
    BvhBuilder<detail::WidePolicy> builder({items_});
    builder.references.resize(items_.size());
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
      const FloatBox& b = items_[i].box;
      builder.references[i] = {{V{b.lo[0], b.lo[1], b.lo[2], 0.0f}, V{b.hi[0], b.hi[1], b.hi[2], 0.0f}}, i};
    }
    builder.build();
    binary_ = std::move(builder.nodes);
    std::vector<Item> sorted;
    sorted.reserve(items_.size());
    for (const auto& reference : builder.references) { sorted.push_back(items_[reference.item]); }
    items_.swap(sorted);
    collapse(out);
  }

 private:
  using V = detail::WidePolicy::V;
  using Binary = BinaryNode<detail::WidePolicy::Bounds>;
  struct Range {
    std::uint32_t first, count;
  };

  // least[i][k]: the least expected cost of the subtree of binary node i if it becomes at most k + 1 children of a wide node; k = 0: a
  // wide node of its own. left[i][k]: how many of these come from its left child; 0: k children are as good.
  struct Merger {
    std::array<float, 8> least;
    std::array<std::uint8_t, 8> left;
    std::uint8_t left7 = 0;  // of eight children, if it is a wide node of its own
  };
  void merge(std::vector<Merger>& mergers) const {
    mergers.resize(binary_.size());
    for (std::size_t i = binary_.size(); i-- > 0;) {  // children come after their parents
      const Binary& node = binary_[i];
      Merger& m = mergers[i];
      m.left.fill(0);
      if (node.count > 0) {
        m.least.fill(node.box.half_area() * leaf_cost);
        continue;
      }
      const Merger &l = mergers[node.first], &r = mergers[node.first + 1];
      for (std::uint32_t k = 1; k < 8; ++k) {
        m.least[k] = no_bound;
        for (std::uint32_t j = 0; j < k; ++j) {
          if (const float sum = l.least[j] + r.least[k - 1 - j]; sum < m.least[k]) {
            m.least[k] = sum, m.left[k] = static_cast<std::uint8_t>(j + 1);
          }
        }
      }
      m.left7 = m.left[7];
      m.least[0] = node.box.half_area() + m.least[7];
      for (std::uint32_t k = 1; k < 8; ++k) {
        if (m.least[k - 1] < m.least[k]) { m.least[k] = m.least[k - 1], m.left[k] = 0; }
      }
    }
  }
  static constexpr float leaf_cost = 1.5f;  // of a block of shapes, relative to a test of eight boxes

  void gather(const std::vector<Merger>& mergers, std::uint32_t at, std::uint32_t k, std::array<std::uint32_t, 8>& child,
              std::size_t& count) const {
    while (k > 0 && mergers[at].left[k] == 0) { --k; }
    if (k == 0 || binary_[at].count > 0) {
      child[count++] = at;
      return;
    }
    const std::uint32_t left = mergers[at].left[k];
    gather(mergers, binary_[at].first, left - 1, child, count);
    gather(mergers, binary_[at].first + 1, k - left, child, count);
  }

  void collapse(std::vector<Node>& out) {
    struct Open {
      std::uint32_t binary, parent, slot;
    };
    std::vector<Merger> mergers;
    merge(mergers);
    std::vector<Open> todo{{0, no_shape, 0}};
    while (!todo.empty()) {
      const Open open = todo.back();
      todo.pop_back();
      const auto index = static_cast<std::uint32_t>(out.size());
      if (open.parent != no_shape) { out[open.parent].child[open.slot] = index; }
      std::array<std::uint32_t, 8> child{open.binary};
      std::size_t count = 0;
      if (binary_[open.binary].count > 0) {
        count = 1;  // a tree with a single leaf
      } else {
        const std::uint32_t left = mergers[open.binary].left7;
        gather(mergers, binary_[open.binary].first, left - 1, child, count);
        gather(mergers, binary_[open.binary].first + 1, 7 - left, child, count);
      }
      // Largest first, because any-hit searches visit these first.
      for (std::size_t i = 1; i < count; ++i) {
        for (std::size_t j = i; j > 0 && binary_[child[j - 1]].box.half_area() < binary_[child[j]].box.half_area(); --j) {
          std::swap(child[j - 1], child[j]);
        }
      }
      Node node;
      for (std::size_t i = 0; i < 8; ++i) {
        for (int k = 0; k < 3; ++k) {
          node.bound[k][i] = i < count ? binary_[child[i]].box.lo[k] : no_bound;
          node.bound[k + 3][i] = i < count ? binary_[child[i]].box.hi[k] : -no_bound;
        }
        node.child[i] = leaf_of(Kind::other, 1, 0);
        if (i >= count) { continue; }
        const Binary& b = binary_[child[i]];
        if (b.count > 0) {
          node.child[i] = leaf({b.first, b.count});
        } else {
          todo.push_back({child[i], index, static_cast<std::uint32_t>(i)});
        }
      }
      out.push_back(node);
    }
  }
  std::uint32_t leaf(const Range& range) {
    const std::span<const Item> items = std::span<const Item>(items_).subspan(range.first, range.count);
    return leaf_of(items[0].kind, range.count, emit_(items[0].kind, items));
  }

  std::vector<Item>& items_;
  Emit emit_;
  std::vector<Binary> binary_;
};

inline void Compiler::finish(std::size_t loop_limit) {
  out_.bodies.reserve(bodies_.size());
  for (std::uint32_t& body : out_.room_bodies) {
    if (body != no_shape) { out_.bodies.push_back(bodies_[std::exchange(body, static_cast<std::uint32_t>(out_.bodies.size()))]); }
  }
  WideTreeBuilder tree(items_, [this](Kind kind, std::span<const Item> items) { return emit(kind, items); });
  if (items_.size() <= loop_limit) { tree.leaves(out_.leaves); }
  if (!items_.empty()) { tree.build(out_.nodes); }
}

}  // namespace raycast
