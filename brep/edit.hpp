// SPDX-License-Identifier: MIT
#pragma once

// Composite operators at an edge: collapse and flip. Written with the operators of euler.hpp alone, so whatever they make is a legal
// BRep; everything is asked before anything is changed, so a refusal changes nothing.

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/result.hpp>
#include <brep/small_list.hpp>

namespace brep {

namespace detail {

// Is the face of h a triangle in which the edge of h occurs once?
template <class B>
[[nodiscard]] bool has_triangle(const B& brep, HalfedgeId h) {
  const HalfedgeId a = brep.next(h), b = brep.next(a);
  return a != h && b != h && brep.next(b) == h && a != twin(h) && b != twin(h);
}

// The first edge between a neighbour of v and one of w that the collapse of h, v -> w, would make parallel to another or turn into a loop.
template <class B>
[[nodiscard]] VertexId common_neighbour(const B& brep, HalfedgeId h) {
  const VertexId v = brep.vertex(h), w = brep.target(h);
  std::array<VertexId, 2> third{};  // merged with its twin edge when the triangle goes
  for (std::size_t i = 0; i < 2; ++i) {
    const HalfedgeId side = i == 0 ? h : twin(h);
    if (has_triangle(brep, side)) { third[i] = brep.target(brep.next(side)); }
  }
  SmallList<VertexId, 32> of_v;
  for (HalfedgeId x : halfedges_from(brep, v)) {
    if (x != h) { of_v.push_back(brep.target(x)); }
  }
  std::sort(of_v.begin(), of_v.end());
  for (HalfedgeId x : halfedges_from(brep, w)) {
    if (x == twin(h)) { continue; }
    const VertexId y = brep.target(x);
    if (y == v) { return v; }
    if (y != w && y != third[0] && y != third[1] && std::binary_search(of_v.begin(), of_v.end(), y)) { return y; }
  }
  return {};
}

// Removes the face of h when it has two edges, and the edge of h with it; what lies beyond h stays.
template <class B>
void remove_two_gon(B& brep, HalfedgeId h) {
  const HalfedgeId other = brep.next(h);
  if (other != h && other != twin(h) && brep.next(other) == h) { unchecked::join_faces(brep, twin(h)); }
}

}  // namespace detail

// Contracts the edge of h into vertex(h), which keeps its data, and merges the edges of the triangles beside it. counts: v-1 e-1-k f-k
//
//           x                 x
//          / \                |             k = 0, 1 or 2 triangles at the edge become an edge each.
//         v-h-w     ==>       v             h: v -> w. vertex(h) stays, w is killed; so are the triangles, and
//          \ /                |             of the two edges that merge the one that ended at w.
//           y                 y
//
// Refused (nothing changes): h is dead; it is a loop; it is the only edge of its shell; the link condition does not hold: v and w have a
// common neighbour other than x and y, or are joined by a second edge. Without that condition two edges between the same vertices, or a
// loop, would arise (legal, and join_vertices makes them). What had parallel edges or loops before may keep them. A tetrahedron becomes
// a triangle with two faces.
// Inverse: split_face for the merged edges, so that they are two, then split_vertex. Time: d(v) log d(v) + d(w) log d(v) for the degrees d.
template <class B>
Result<VertexId> collapse_edge(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  const HalfedgeId t = twin(h);
  if (brep.vertex(h) == brep.target(h)) { return Refusal{Code::same_vertex, {h, brep.vertex(h)}}; }
  if (brep.next(h) == t && brep.next(t) == h) { return Refusal{Code::last_edge, {h}}; }
  if (const VertexId x = detail::common_neighbour(brep, h); x.valid()) { return Refusal{Code::link_condition, {h, x}}; }
  const bool left = detail::has_triangle(brep, h), right = detail::has_triangle(brep, t);
  const HalfedgeId from_w = brep.next(h), from_v = brep.next(t), to_w = brep.prev(t);
  const VertexId v = unchecked::join_vertices(brep, h);
  if (left) { detail::remove_two_gon(brep, from_w); }
  if (right) { detail::remove_two_gon(brep, brep.alive(to_w) ? to_w : from_v); }
  return v;
}

// Turns the edge of h by one corner, counter-clockwise, within the polygon of its two faces.       counts: none
//
//      *---w---*         *---w---*       h ran v -> w; the ends move on to the next corners of the polygon.
//      |   ^   |         |       |       Handles and data of h's faces stay: face(h) has the edges that it had, without the
//      x f h g y   ==>   x <-h-- y       one that began at w, and with the one that began at v; face(twin(h)) accordingly.
//      |   |   |         |       |       The data of the two halves are new.
//      *---v---*         *---v---*
//      (w - x and v - y adjacent)        Face data that cannot be copied: those of the second half's face start anew.
//
// An edge between x and y may exist already; then there are two, which is legal.
// Refused (nothing changes): h is dead; both sides are the same face; one of them has this edge alone.
// Inverse: flip_edge again, as often as the polygon has corners less one; for two triangles 3 times (4 flips are none, 2 turn h around).
template <class B>
Result<HalfedgeId> flip_edge(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  const HalfedgeId first = halfedge(edge(h)), second = twin(first);  // the new edge has its first half first
  const FaceId f = brep.face(first), g = brep.face(second);
  if (f == g) { return Refusal{Code::cannot_flip, {h, f}}; }
  if (brep.next(first) == first) { return Refusal{Code::cannot_flip, {h, f}}; }
  if (brep.next(second) == second) { return Refusal{Code::cannot_flip, {h, g}}; }
  const HalfedgeId a = brep.next(first), c = brep.next(second);
  using Data = typename B::face_type;
  if constexpr (std::is_copy_constructible_v<Data> && std::is_copy_assignable_v<Data> && !std::is_empty_v<Data>) {
    const Data data_of_g = brep.data(g);
    unchecked::join_faces(brep, first);
    unchecked::split_face(brep, brep.next(c), brep.next(a));
    brep.data(g) = data_of_g;
  } else {
    unchecked::join_faces(brep, first);
    unchecked::split_face(brep, brep.next(c), brep.next(a));
  }
  return h;
}

}  // namespace brep
