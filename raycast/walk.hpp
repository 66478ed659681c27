// SPDX-License-Identifier: MIT
#pragma once

// The traversal under all searches of trees: top down, depth first, with a stack of postponed subtrees, without heap memory. A search
// defines in two functions what happens at an inner node and at a leaf, so each search is about ten lines: any hit and first hit, along a
// line or around a point, for one ray or sixteen, through the binary trees of bvh.hpp and the eight-wide tree of compiled.hpp.
//
//   walk(tree, root, wanted, leaf, inner) -> bool
//
//   root                   an Open: `child`, a node of the tree (compiled.hpp: or a leaf), and the search's own data about it, such as the
//                          entry parameter of the ray, or the lanes that are alive
//   wanted(at) -> bool     called when it is a subtree's turn: does it still matter? May narrow `at`. everything: always true
//   leaf(at) -> bool       true ends the walk, which then returns true; otherwise the walk returns false at the end
//   inner(at, put_off) -> bool
//                          pushes the children that matter on `put_off`; the last one is visited first. true: continue at once with `at`,
//                          which has been set to one of the children
//
// The function itself is in kernels/walk.inc, because it is compiled for every instruction set; code without vectors uses portable::walk.

#include <cstddef>
#include <type_traits>

#include <raycast/bvh_builder.hpp>

namespace raycast {

// Upper bound: on the way down, each node leaves behind all its children except one.
template <class Tree>
inline constexpr std::size_t walk_stack_size = (Tree::fan_out - 1) * tree_depth_limit + 1;

// The postponed subtrees of a walk.
template <class Tree, class Open>
class PutOff {
  static_assert(std::is_trivially_copyable_v<Open> && std::is_trivially_default_constructible_v<Open>);

 public:
  PutOff() {}  // not "= default": the entries stay uninitialised

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  void push(const Open& open) { entries_[size_++] = open; }
  const Open& pop() { return entries_[--size_]; }  // valid until the next push

  // Inserts the entry among those above `bottom`, sorted so that the one with the least `at` comes next.
  void push_sorted(std::size_t bottom, const Open& open) {
    std::size_t place = size_++;
    for (; place > bottom && entries_[place - 1].at < open.at; --place) { entries_[place] = entries_[place - 1]; }
    entries_[place] = open;
  }

 private:
  std::size_t size_ = 0;
  Open entries_[walk_stack_size<Tree>];
};

inline constexpr auto everything = [](const auto&) { return true; };

}  // namespace raycast

#define HALFLIGHT_ISA portable
#define HALFLIGHT_OP inline
#include "kernels/walk.inc"
#undef HALFLIGHT_ISA
#undef HALFLIGHT_OP
