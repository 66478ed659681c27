// SPDX-License-Identifier: MIT
#pragma once

// The walk under all searches of trees: top down, depth first, with a stack of what is put off; the heap is not touched. A search says in
// two functions what it does at an inner node and at a leaf, and so is ten lines: any hit and first hit, along a line or around a point,
// for one ray or for sixteen, through the binary trees of bvh.hpp and the eight-wide one of compiled.hpp.
//
//   walk(tree, root, wanted, leaf, inner) -> bool
//
//   root                   an Open: `child`, a node of the tree (compiled.hpp: or a leaf), and what this search knows of it: where the ray
//                          enters, which lanes are alive
//   wanted(at) -> bool     asked when a subtree's turn comes: does it matter still? May narrow `at`. everything: always.
//   leaf(at) -> bool       true ends the walk, which returns true; without, it returns false in the end
//   inner(at, put_off) -> bool
//                          pushes those children that matter on `put_off`; the last is looked at first. true: goes on with `at` at once,
//                          which has become one of the children
//
// The function itself is in kernels/walk.inc, because it is compiled for every instruction set; portable::walk is the one for code that is
// written in no vectors.

#include <cstddef>
#include <type_traits>

#include <raycast/bvh_builder.hpp>

namespace raycast {

// Walking down a path leaves all children but one of each of its nodes behind.
template <class Tree>
inline constexpr std::size_t walk_stack_size = (Tree::fan_out - 1) * tree_depth_limit + 1;

// What a walk has put off.
template <class Tree, class Open>
class PutOff {
  static_assert(std::is_trivially_copyable_v<Open> && std::is_trivially_default_constructible_v<Open>);

 public:
  PutOff() {}  // not "= default": the entries stay uninitialised

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  void push(const Open& open) { entries_[size_++] = open; }
  const Open& pop() { return entries_[--size_]; }  // valid until the next push

  // Sorts the entry in among those above `bottom`: the one of least `at` comes next.
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
