// SPDX-License-Identifier: MIT
#pragma once

// Composite operators on two faces of equal degree: glue them, or join them by a tunnel. Written with the operators of euler.hpp
// alone; everything is asked before anything is changed, so a refusal changes nothing.
//
// Both begin with a bridge between the faces f and g, whose loops then run side by side in opposite directions:
//
//        v0 ---a--> v1 --->  ...      loop of f         half-edge a, v0 -> v1, lies opposite to c, u1 -> u0:
//        |          .                                   u0 belongs to v0, u1 to v1, and so on round both loops.
//        u0 <--c--- u1 <---  ...      loop of g
//
// Every case is legal: faces of two shells (which become one), of one shell (which gets a handle), faces that share vertices
// or edges. Where two corners that belong together are one vertex already, closing the gap does not unite vertices, it
// separates the two sides of that vertex (unweld): as for every permutation, exchanging two elements merges two cycles or splits one.

#include <cstddef>
#include <type_traits>

#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/extrude.hpp>  // has_room
#include <brep/result.hpp>

namespace brep {

namespace detail {

template <class B>
[[nodiscard]] Refusal check_pair(const B& brep, HalfedgeId a, HalfedgeId c) {
  if (!brep.alive(a)) { return {Code::dead, {a}}; }
  if (!brep.alive(c)) { return {Code::dead, {c}}; }
  if (brep.face(a) == brep.face(c)) { return {Code::equal_faces, {a, c}}; }
  if (degree(brep, brep.face(a)) != degree(brep, brep.face(c))) { return {Code::different_degrees, {a, c}}; }
  return {};
}

// Removes the edge of h such that the corners at its ends become one: the vertices are united, vertex(h) stays; or they are one,
// which falls into two with equal data.
template <class B>
void close_gap(B& brep, HalfedgeId h) {
  if (brep.vertex(h) != brep.target(h)) {
    unchecked::join_vertices(brep, h);
    return;
  }
  const VertexId v = brep.vertex(h), w = unchecked::unweld(brep, h);
  using Data = typename B::vertex_type;
  if constexpr (std::is_copy_assignable_v<Data> && !std::is_empty_v<Data>) { brep.data(w) = brep.data(v); }
}

}  // namespace detail

// Glues the face g of c to the face f of a, the half-edge c to a and so on round; both faces vanish.
//                                   counts: v-n e-n f-2 for faces of degree n that share no vertex (s-1 or h+1)
//
//      +-----+ +-----+        +-----+-----+
//      |    f| |g    |  ==>   |     |     |      The vertices and edges of f stay, with their data; those of g are killed.
//      +-----+ +-----+        +-----+-----+
//
// A shared vertex that belongs to itself falls into two, with equal data; an edge that f and g share and that is glued to itself vanishes;
// when all edges do, as with the two sides of a sheet, so does the shell.
// Returns the number of edges of the seam, at most n. The half-edge a lives on unless its edge vanishes.
//
// Refused (nothing changes): a or c is dead; they lie on one face; the faces have different degrees; no handle is left.
// Inverse, for faces that had nothing in common: split_face doubles the edges of the seam, split_vertex parts its vertices between the
// doubles, join_faces removes all but one of the edges that arise there, cut the last. With a log: undo_to.
// Time: the edges of both faces, and the edges of what is killed: the vertices of g and two-edge faces.
template <class B>
Result<std::size_t> glue_faces(B& brep, HalfedgeId a, HalfedgeId c) {
  if (const Refusal refusal = detail::check_pair(brep, a, c); refusal.code != Code::none) { return refusal; }
  if (detail::Raw::halfedges(brep).full()) { return Refusal{Code::full, {}}; }
  std::size_t seam = 0, pairs = degree(brep, brep.face(a));
  detail::close_gap(brep, unchecked::bridge(brep, a, brep.next(c)));
  for (; pairs > 1; --pairs) {  // one loop of 2 * pairs half-edges, where c comes before a
    c = brep.prev(a);
    HalfedgeId next = brep.next(a);
    if (c == twin(a)) {
      unchecked::join_vertices(brep, c);
    } else {
      detail::close_gap(brep, twin(unchecked::split_face(brep, c, next)));  // c and a are the loop of a two-edge face now
      if (next == twin(c)) {
        next = a;  // which takes its place
      }
      unchecked::join_faces(brep, twin(c));
      ++seam;
    }
    a = next;
  }
  c = brep.prev(a);
  if (c == twin(a)) {
    unchecked::kill_segment(brep, a);
  } else {
    unchecked::join_faces(brep, twin(c));
    ++seam;
  }
  return seam;
}

// Joins the faces f of a and g of c by a tunnel: both vanish, n quadrilaterals join their loops, the first one a to c. counts: e+n f+n-2
//
//      +--f--+          +-. .-+
//      |     |    ==>   | | | |      f and g of one shell: it gets a handle, a hole is punched through the solid. Of two shells: they
//      |     |          | | | |      become one, outer and inner boundary of a hollow or two solids with a passage.
//      +--g--+          +-' '-+      No vertex is made. The quadrilaterals have the data of f, the last one has its handle.
//
// Returns the first edge of the tunnel, h: vertex(a) -> target(c); face(twin(h)) has a and c, face(h) is the last quadrilateral.
// The hole has the size of the faces: to punch a smaller one, extrude_face both first with a `place` that moves the cap inward.
//
// Refused (nothing changes): a or c is dead; they lie on one face; the faces have different degrees; no handle is left.
// Inverse: join_faces for the other edges of the tunnel, last made first, then cut(h).
template <class B>
Result<HalfedgeId> punch_hole(B& brep, HalfedgeId a, HalfedgeId c) {
  if (const Refusal refusal = detail::check_pair(brep, a, c); refusal.code != Code::none) { return refusal; }
  const std::size_t n = degree(brep, brep.face(a));
  if (!detail::has_room(brep, n)) { return Refusal{Code::full, {}}; }
  const HalfedgeId h = unchecked::bridge(brep, a, brep.next(c));
  HalfedgeId rung = twin(h);  // the loop runs: half-edge of g, rung, half-edge of f
  for (std::size_t i = 1; i < n; ++i) { rung = unchecked::split_face(brep, brep.prev(rung), brep.next(brep.next(rung))); }
  return h;
}

}  // namespace brep
