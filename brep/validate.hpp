// SPDX-License-Identifier: MIT
#pragma once

// Is this BRep what brep.hpp promises? All faults at once, each with its rule, the elements and a sentence.
//
//   R1  every handle in a record names a living element
//   R2  next(h) starts where h ends
//   R3  next and prev are inverse
//   R4  the loop of a face is exactly the half-edges that name the face
//   R5  the half-edges around a vertex are exactly those that name the vertex
//   R6  the anchor of a face lies on it, the anchor of a vertex leaves it
//   R7  the free lists hold exactly the dead slots
//   R8  the counters are right, and in each shell v - e + f = 2 - 2h with an integer h >= 0
//
// These are the rules of structure. Loops, spurs and faces of one edge obey them; what an algorithm may want beyond has
// the numbers from R9 on, in validate_constraints.hpp. Counting cannot replace R1 to R5: a box and a loose ring of
// faces have v - e + f = 2 together, like one sphere. But R1 to R7 imply R8: every shell is then a closed orientable surface, for
// which R8 is Euler's theorem. So shells are counted only where one of R1 to R7 fails, to say which shell has wrong counts.
//
// Linear time, also on damaged records. `is_valid` is the fast pass, without allocation; `validate` asks it first and looks for
// sentences (validate_explain.hpp) only when it says no.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/brep.hpp>
#include <brep/validate_explain.hpp>

namespace brep {

namespace detail {

// The free list has as many slots as there are dead ones, all dead, and then ends. So no slot is on it twice: such a list never ends.
template <class PoolType>
bool free_list_is_sound(const PoolType& pool, std::uint32_t step) {
  if (pool.size() % step != 0 || pool.count() > pool.size() / step) { return false; }
  std::uint32_t i = pool.first_free();
  for (std::uint32_t dead = pool.size() / step - pool.count(); dead > 0; --dead) {
    if (i >= pool.size() || i % step != 0 || pool.alive(i)) { return false; }
    i = link(pool[i]) & ~PoolType::dead_bit;
  }
  return i == PoolType::end_of_list;
}

// Does a living half-edge h have this dead slot as its next? Then the record in the slot has h as its prev (R3), so the slot tells.
template <class Halfedges>
bool is_entered(const Halfedges& halfedges, std::uint32_t dead) {
  for (std::uint32_t x : {dead, dead + 1}) {
    const std::uint32_t before = halfedges[x].prev.index;
    if (halfedges.alive(before) && halfedges[before].next.index == x) { return true; }
  }
  return false;
}

// One look at each edge, in the order of memory. Afterwards next is a permutation of the live half-edges with the inverse prev, it
// keeps the face, and twin followed by next keeps the vertex. That no next is dead is asked of the dead slots (is_entered).
template <class B>
bool steps_are_sound(const B& brep) {
  const auto& halfedges = Raw::halfedges(brep);
  const std::uint32_t end = halfedges.size();
  std::size_t live = 0;
  for (std::uint32_t h = 0; h < end; h += 2) {
    const HalfedgeRecord* const pair = &halfedges[h];
    const HalfedgeRecord &r = pair[0], &t = pair[1];
    if ((link(r) & halfedges.dead_bit) != 0) {
      if (is_entered(halfedges, h)) { return false; }
      continue;
    }
    if ((r.next.index >= end) | (t.next.index >= end)) { return false; }
    const HalfedgeRecord &after_r = halfedges[r.next.index], &after_t = halfedges[t.next.index];
    if ((after_r.prev.index ^ h) | (after_t.prev.index ^ (h + 1)) | (after_r.face.index ^ r.face.index) |
        (after_t.face.index ^ t.face.index) | (after_r.vertex.index ^ t.vertex.index) | (after_t.vertex.index ^ r.vertex.index)) {
      return false;
    }
    ++live;
  }
  return live == halfedges.count();
}

// Where all steps are sound: the walk from each anchor is closed, and walks from different anchors are disjoint, since each has
// one owner. So they meet 2e half-edges together exactly when every half-edge lies on the walk of the element that it names.
template <class PoolType, class Halfedges, class Owner, class Step>
bool walks_meet_all(const PoolType& elements, const Halfedges& halfedges, Owner&& owner, Step&& step) {
  std::size_t met = 0, live = 0;
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    const std::uint32_t anchor = link(elements[i]);
    if ((anchor & elements.dead_bit) != 0) { continue; }
    if (!halfedges.alive(anchor) || owner(halfedges[anchor]) != i) { return false; }
    ++live;
    std::uint32_t h = anchor;
    do {
      h = step(h);
      ++met;
    } while (h != anchor);
  }
  return live == elements.count() && met == 2 * std::size_t{halfedges.count()};
}

}  // namespace detail

// Does the BRep keep R1 to R8? No allocation, three linear passes (some 2 ns a half-edge), never lost on damaged records.
template <class B>
[[nodiscard]] bool is_valid(const B& brep) {
  using namespace detail;
  const auto& halfedges = Raw::halfedges(brep);
  const auto& vertices = Raw::vertices(brep);
  const auto& faces = Raw::faces(brep);
  return free_list_is_sound(halfedges, 2) && free_list_is_sound(vertices, 1) && free_list_is_sound(faces, 1) && steps_are_sound(brep) &&
         walks_meet_all(
             faces, halfedges, [](const HalfedgeRecord& r) { return r.face.index; },
             [&](std::uint32_t h) { return halfedges[h].next.index; }) &&
         walks_meet_all(
             vertices, halfedges, [](const HalfedgeRecord& r) { return r.vertex.index; },
             [&](std::uint32_t h) { return halfedges[h ^ 1u].next.index; });
}

// All faults of the records; empty for a valid BRep. Fault texts name elements by handle, so they can be looked up.
template <class B>
[[nodiscard]] std::vector<Fault> validate(const B& brep) {
  if (is_valid(brep)) { return {}; }
  return detail::Explanation<B>(brep).run();
}

}  // namespace brep
