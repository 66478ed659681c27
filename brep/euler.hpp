// SPDX-License-Identifier: MIT
#pragma once

// Euler operators: the only changes of topology (paper 2.1; Baumgart 1974; Mäntylä 1988, ch. 9).
//
// Each keeps the invariant of brep.hpp and v - e + f = 2(s - h); everything else is written with them. split_face and
// split_vertex are each other's dual: exchange the words face and vertex, "on the loop of" and "leaving". An impossible
// request is refused with a reason and changes nothing; the same functions in `unchecked::` trust the caller.
// New half-edges have default data, a new face gets a copy of the data of the face that was split, a new vertex default data.
//
// The new edge always takes h = its first half, so h is even. An operator followed by its inverse restores every record,
// anchors and free lists included. Anchors are kept where possible; when the anchor of a split face (vertex) falls to the
// new one, it stays the anchor there and h becomes the anchor of the old one.
// Time: each operator is O(1) plus a relabelling of the half-edges of the new (killed) face or vertex; first_side_is_shorter
// finds in the time of the shorter side which way round to ask. No operator allocates while free slots are left.

#include <brep/brep.hpp>
#include <brep/result.hpp>

namespace brep {

namespace unchecked {

using detail::Raw;

template <class B>
HalfedgeId make_segment(B& brep) {
  const HalfedgeId h = Raw::new_edge(brep), t = twin(h);
  const VertexId v = Raw::new_vertex(brep), w = Raw::new_vertex(brep);
  const FaceId f = Raw::new_face(brep);
  Raw::at(brep, h) = {t, t, v, f};
  Raw::at(brep, t) = {h, h, w, f};
  Raw::at(brep, v).halfedge = h;
  Raw::at(brep, w).halfedge = t;
  Raw::at(brep, f).halfedge = h;
  return h;
}

template <class B>
void kill_segment(B& brep, HalfedgeId h) {
  const VertexId v = brep.vertex(h), w = brep.target(h);
  Raw::kill(brep, brep.face(h));
  Raw::kill(brep, w);
  Raw::kill(brep, v);
  Raw::kill(brep, edge(h));
}

template <class B>
HalfedgeId split_face(B& brep, HalfedgeId a, HalfedgeId b) {
  const HalfedgeId h = Raw::new_edge(brep), t = twin(h);
  const FaceId f = brep.face(a), g = Raw::new_face(brep, f);
  const VertexId v = brep.vertex(a), w = brep.vertex(b);
  const HalfedgeId before_a = brep.prev(a), before_b = brep.prev(b);
  if (a == b) {
    Raw::at(brep, h) = {a, before_a, v, f};
    Raw::at(brep, t) = {t, t, v, g};
    Raw::at(brep, before_a).next = h;
    Raw::at(brep, a).prev = h;
    Raw::at(brep, g).halfedge = t;
    return h;
  }
  Raw::at(brep, h) = {b, before_a, v, f};
  Raw::at(brep, t) = {a, before_b, w, g};
  Raw::at(brep, before_a).next = h;
  Raw::at(brep, before_b).next = t;
  Raw::at(brep, a).prev = t;
  Raw::at(brep, b).prev = h;
  const HalfedgeId anchor = brep.halfedge(f);
  HalfedgeId anchor_of_g = t;
  for (HalfedgeId x = a; x != t; x = brep.next(x)) {
    if (x == anchor) anchor_of_g = x;
    Raw::at(brep, x).face = g;
  }
  Raw::at(brep, g).halfedge = anchor_of_g;
  if (anchor_of_g != t) Raw::at(brep, f).halfedge = h;
  return h;
}

template <class B>
FaceId join_faces(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h);
  const FaceId f = brep.face(h), g = brep.face(t);
  const HalfedgeId before_h = brep.prev(h), after_h = brep.next(h);
  const HalfedgeId before_t = brep.prev(t), after_t = brep.next(t);
  for (HalfedgeId x = after_t; x != t; x = brep.next(x)) Raw::at(brep, x).face = f;
  const bool h_alone = after_h == h, t_alone = after_t == t;  // a one-edge face; never both
  const HalfedgeId from_v = t_alone ? after_h : after_t;      // leaves vertex(h) and stays
  const HalfedgeId from_w = h_alone ? after_t : after_h;      // leaves target(h) and stays
  const HalfedgeId to_v = h_alone ? before_t : before_h;
  const HalfedgeId to_w = t_alone ? before_h : before_t;
  Raw::at(brep, to_v).next = from_v;
  Raw::at(brep, from_v).prev = to_v;
  Raw::at(brep, to_w).next = from_w;
  Raw::at(brep, from_w).prev = to_w;
  if (brep.halfedge(brep.vertex(h)) == h) Raw::at(brep, brep.vertex(h)).halfedge = from_v;
  if (brep.halfedge(brep.vertex(t)) == t) Raw::at(brep, brep.vertex(t)).halfedge = from_w;
  if (brep.halfedge(f) == h) {
    const HalfedgeId other = brep.halfedge(g);
    Raw::at(brep, f).halfedge = other != t ? other : from_w;
  }
  Raw::kill(brep, g);
  Raw::kill(brep, edge(h));
  return f;
}

template <class B>
HalfedgeId split_vertex(B& brep, HalfedgeId a, HalfedgeId b) {
  const HalfedgeId h = Raw::new_edge(brep), t = twin(h);
  const VertexId v = brep.vertex(a), w = Raw::new_vertex(brep);
  const HalfedgeId before_a = brep.prev(a), before_b = brep.prev(b);
  if (a == b) {
    Raw::at(brep, h) = {t, before_a, v, brep.face(a)};
    Raw::at(brep, t) = {a, h, w, brep.face(a)};
    Raw::at(brep, before_a).next = h;
    Raw::at(brep, a).prev = t;
    Raw::at(brep, w).halfedge = t;
    return h;
  }
  const HalfedgeId anchor = brep.halfedge(v);
  HalfedgeId anchor_of_w = t;
  for (HalfedgeId x = a; x != b; x = brep.next(twin(x))) {
    if (x == anchor) anchor_of_w = x;
    Raw::at(brep, x).vertex = w;
  }
  Raw::at(brep, h) = {a, before_a, v, brep.face(a)};
  Raw::at(brep, t) = {b, before_b, w, brep.face(b)};
  Raw::at(brep, before_a).next = h;
  Raw::at(brep, before_b).next = t;
  Raw::at(brep, a).prev = h;
  Raw::at(brep, b).prev = t;
  Raw::at(brep, w).halfedge = anchor_of_w;
  if (anchor_of_w != t) Raw::at(brep, v).halfedge = h;
  return h;
}

template <class B>
VertexId join_vertices(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h);
  const VertexId v = brep.vertex(h), w = brep.vertex(t);
  for (HalfedgeId x = brep.next(h); x != t; x = brep.next(twin(x))) Raw::at(brep, x).vertex = v;
  // Where the walk goes on when h and t are taken out; a spur has h and t behind one another.
  const HalfedgeId after_h = brep.next(h) == t ? brep.next(t) : brep.next(h);
  const HalfedgeId after_t = brep.next(t) == h ? brep.next(h) : brep.next(t);
  for (HalfedgeId x : {h, t}) {
    const HalfedgeId before = brep.prev(x), after = brep.next(x);
    Raw::at(brep, before).next = after;
    Raw::at(brep, after).prev = before;
  }
  if (brep.halfedge(brep.face(h)) == h) Raw::at(brep, brep.face(h)).halfedge = after_h;
  if (brep.halfedge(brep.face(t)) == t) Raw::at(brep, brep.face(t)).halfedge = after_t;
  if (brep.halfedge(v) == h) {
    const HalfedgeId other = brep.halfedge(w);
    Raw::at(brep, v).halfedge = other != t ? other : after_t;
  }
  Raw::kill(brep, w);
  Raw::kill(brep, edge(h));
  return v;
}

template <class B>
HalfedgeId split_edge(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h), back = Raw::new_edge(brep), n = twin(back);
  const VertexId b = brep.vertex(t), m = Raw::new_vertex(brep);
  const HalfedgeId after_h = brep.next(h);
  Raw::at(brep, n) = {after_h, h, m, brep.face(h)};
  Raw::at(brep, h).next = n;
  Raw::at(brep, after_h).prev = n;
  const HalfedgeId before_t = brep.prev(t);  // n itself when b was the end of a spur
  Raw::at(brep, back) = {t, before_t, b, brep.face(t)};
  Raw::at(brep, before_t).next = back;
  Raw::at(brep, t).prev = back;
  Raw::at(brep, t).vertex = m;
  const bool anchored = brep.halfedge(b) == t;
  Raw::at(brep, m).halfedge = anchored ? t : n;
  if (anchored) Raw::at(brep, b).halfedge = back;
  return n;
}

}  // namespace unchecked

// Makes a new shell: two vertices, one edge, one face on both sides of it.                 counts: v+2 e+1 f+1 (s+1)
//
//      (nothing)   ==>   v *---h---> * w      h runs v -> w, next(h) = twin(h); the smallest shell there is.
//
// Refused: no handle is left.     Inverse: kill_segment(h).
template <class B>
Result<HalfedgeId> make_segment(B& brep) {
  if (detail::Raw::halfedges(brep).full()) return Refusal{Code::full, {}};
  return unchecked::make_segment(brep);
}

// Removes a shell that is a segment. Returns true.                                         counts: v-2 e-1 f-1 (s-1)
// Refused (nothing changes): h is dead; its shell has another edge.     Inverse: make_segment (all data are lost).
template <class B>
Result<bool> kill_segment(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) return Refusal{Code::dead, {h}};
  if (brep.next(h) != twin(h) || brep.prev(h) != twin(h)) return Refusal{Code::not_a_segment, {h}};
  unchecked::kill_segment(brep, h);
  return true;
}

// Inserts the edge a.vertex - b.vertex and splits their common face in two.                counts: e+1 f+1
//
//      *---b---*          *---b---*
//      |       |          |   |   |        new edge h runs a.vertex -> b.vertex;
//      |   f   |   ==>    | f | g |        b's side keeps f = face(h), a's side is the new face g = face(twin(h)).
//      *---a---*          *---a---*        a == b gives a face with one edge: g = { twin(h) }.
//
// Refused (nothing changes): a or b is dead; they lie on different faces.     Inverse: join_faces(h).
// Time: the length of a's side. Swap a and b when the sides are alike and b's is shorter: see first_side_is_shorter.
template <class B>
Result<HalfedgeId> split_face(B& brep, HalfedgeId a, HalfedgeId b) {
  if (!brep.alive(a)) return Refusal{Code::dead, {a}};
  if (!brep.alive(b)) return Refusal{Code::dead, {b}};
  if (brep.face(a) != brep.face(b)) return Refusal{Code::different_faces, {a, b}};
  if (detail::Raw::halfedges(brep).full()) return Refusal{Code::full, {}};
  return unchecked::split_face(brep, a, b);
}

// Removes the edge of h and the face on its right; the face on its left grows. Returns it.  counts: e-1 f-1
//
//      *-------*          *-------*
//      |   ^   |          |       |        f = face(h) stays, g = face(twin(h)) is killed,
//      | f h g |   ==>    |   f   |        with the data of g and of both halves.
//      *---|---*          *-------*
//
// Refused (nothing changes): h is dead; both sides are the same face; h is the only edge of its shell.
// Inverse: split_face(next(twin(h)), next(h)), read before; with next(x) = x for a one-edge face, the other one twice.
// (Where the one-edge face is face(h) itself, the inverse restores the shape with the names of f and g exchanged.)
template <class B>
Result<FaceId> join_faces(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) return Refusal{Code::dead, {h}};
  if (brep.face(h) == brep.face(twin(h))) return Refusal{Code::same_face, {h, brep.face(h)}};
  if (brep.next(h) == h && brep.next(twin(h)) == twin(h)) return Refusal{Code::last_edge, {h}};
  return unchecked::join_faces(brep, h);
}

// Splits the vertex that a and b leave by a new edge in the corners before a and before b.    counts: v+1 e+1
//
//      \   / a          \       / a       new edge h runs v -> w: next(h) = a, next(twin(h)) = b.
//       \ /              \     /
//        v        ==>      v-h->w         b's side keeps v, a's side goes to the new vertex w:
//       / \              /     \         a and what follows it clockwise before b.
//    b /   \          b /       \        a == b gives a spur v -> w -> v, in face(a) before a.
//
// Refused (nothing changes): a or b is dead; they leave different vertices.     Inverse: join_vertices(h).
// Time: the number of half-edges on a's side.
template <class B>
Result<HalfedgeId> split_vertex(B& brep, HalfedgeId a, HalfedgeId b) {
  if (!brep.alive(a)) return Refusal{Code::dead, {a}};
  if (!brep.alive(b)) return Refusal{Code::dead, {b}};
  if (brep.vertex(a) != brep.vertex(b)) return Refusal{Code::different_vertices, {a, b}};
  if (detail::Raw::halfedges(brep).full()) return Refusal{Code::full, {}};
  return unchecked::split_vertex(brep, a, b);
}

// Contracts the edge of h into the vertex where it starts, and returns that vertex.         counts: v-1 e-1
//
//      \         /        \ /
//       v---h-->w    ==>   v               v = vertex(h) stays, w = target(h) is killed; its edges leave v now.
//      /         \        / \              Neighbouring faces lose one edge and may become one-edge faces.
//
// Refused (nothing changes): h is dead; h is a loop; h is the only edge of its shell.
// Inverse: split_vertex(next(h), next(twin(h))), read before; for a spur that ends at w, next(twin(h)) twice.
// (Where v is the end of a spur, the inverse restores the shape with the names of v and w exchanged.)
template <class B>
Result<VertexId> join_vertices(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) return Refusal{Code::dead, {h}};
  if (brep.vertex(h) == brep.target(h)) return Refusal{Code::same_vertex, {h, brep.vertex(h)}};
  if (brep.next(h) == twin(h) && brep.prev(h) == twin(h)) return Refusal{Code::last_edge, {h}};
  return unchecked::join_vertices(brep, h);
}

// Puts a new vertex m on the edge of h; h keeps its start, the result is n = next(h).        counts: v+1 e+1
//
//      a ------h------> b    ==>    a ---h---> m ---n---> b        m = vertex(n) has default data.
//
// The special case of split_vertex at b where twin(h) alone changes its vertex: twin(h) runs m -> a afterwards.
// Refused (nothing changes): h is dead.     Inverse: join_vertices(twin(n)).     Time: O(1).
template <class B>
Result<HalfedgeId> split_edge(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) return Refusal{Code::dead, {h}};
  if (detail::Raw::halfedges(brep).full()) return Refusal{Code::full, {}};
  return unchecked::split_edge(brep, h);
}

// For two half-edges of one loop: is the way a -> b no longer than the way b -> a? Walks both at once, so it costs the
// shorter way only. split_face(a, b) relabels the first way, split_face(b, a) the second; a caller who does not mind which
// side gets the new name asks here and cuts a loop of n edges in O(shorter side).
template <class B>
[[nodiscard]] bool first_side_is_shorter(const B& brep, HalfedgeId a, HalfedgeId b) {
  if (a == b) return true;
  for (HalfedgeId x = a, y = b;;) {
    x = brep.next(x);
    if (x == b) return true;
    y = brep.next(y);
    if (y == a) return false;
  }
}

}  // namespace brep
