// SPDX-License-Identifier: MIT
#pragma once

// Euler operators: the only changes of topology (paper 2.1; Baumgart 1974; Mäntylä 1988, ch. 9).
//
// Each keeps the invariant of brep.hpp and v - e + f = 2(s - h); everything else is written with them. An impossible request is
// refused with a reason and changes nothing; the same functions in `unchecked::` trust the caller. Dual are split_face and split_vertex,
// join_faces and join_vertices, bridge and weld, cut and unweld: exchange the words face and vertex, "on the loop of" and "leaving".
//
//                    v   e   f    2(s - h)              inverse             textbook names of both
//   make_segment    +2  +1  +1   s + 1                  kill_segment        mvfs, then mev; kev, then kvfs
//   split_face          +1  +1   the same               join_faces          mef; kef
//   split_vertex    +1  +1       the same               join_vertices       mev; kev (split_edge is a special case)
//   bridge              +1  -1   s - 1 or h + 1         cut                 kfmrh, then mekr; kemr, then mfkrh
//   weld            -1  +1       s - 1 or h + 1         unweld              none: the duals of bridge and cut
//
// euler_table.hpp has the same as a table for programs: the script language, the log and replay read it.
// The new edge always takes h = its first half, so h is even. An operator that adds an edge to a face or vertex, followed by its inverse,
// restores every record. What a killed face or vertex had as anchor and data only a log knows (euler_log.hpp);
// inherit.hpp says what the data of new elements are.
// Time: O(1) plus a renaming of the half-edges of the new (killed) face or vertex; first_side_is_shorter finds in the time of the shorter
// side which way round to ask. No operator allocates while free slots are left.

#include <brep/brep.hpp>
#include <brep/result.hpp>
#include <brep/unchecked.hpp>

namespace brep {

// Makes a new shell: two vertices, one edge, one face on both sides of it.                 counts: v+2 e+1 f+1 (s+1)
// Textbook: mvfs, which makes a vertex without an edge, and then mev.
//
//      (nothing)   ==>   v *---h---> * w      h runs v -> w, next(h) = twin(h); the smallest shell there is.
//
// Refused: no handle is left.     Inverse: kill_segment(h).
template <class B>
Result<HalfedgeId> make_segment(B& brep) {
  if (detail::Raw::halfedges(brep).full()) { return Refusal{Code::full, {}}; }
  return unchecked::make_segment(brep);
}

// Removes a shell that is a segment. Returns true.                                         counts: v-2 e-1 f-1 (s-1)
// Textbook: kev, and then kvfs.
// Refused (nothing changes): h is dead; its shell has another edge.     Inverse: make_segment (all data are lost).
template <class B>
Result<bool> kill_segment(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  if (brep.next(h) != twin(h) || brep.prev(h) != twin(h)) { return Refusal{Code::not_a_segment, {h}}; }
  unchecked::kill_segment(brep, h);
  return true;
}

// Inserts the edge a.vertex - b.vertex and splits their common face in two. Textbook: mef.   counts: e+1 f+1
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
  if (!brep.alive(a)) { return Refusal{Code::dead, {a}}; }
  if (!brep.alive(b)) { return Refusal{Code::dead, {b}}; }
  if (brep.face(a) != brep.face(b)) { return Refusal{Code::different_faces, {a, b}}; }
  if (detail::Raw::halfedges(brep).full()) { return Refusal{Code::full, {}}; }
  return unchecked::split_face(brep, a, b);
}

// Removes the edge of h and the face on its right; the face on its left grows. Returns it.  counts: e-1 f-1
// Textbook: kef.
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
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  if (brep.face(h) == brep.face(twin(h))) { return Refusal{Code::same_face, {h, brep.face(h)}}; }
  if (brep.next(h) == h && brep.next(twin(h)) == twin(h)) { return Refusal{Code::last_edge, {h}}; }
  return unchecked::join_faces(brep, h);
}

// Splits the vertex that a and b leave by a new edge in the corners before a and before b.    counts: v+1 e+1
// Textbook: mev.
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
  if (!brep.alive(a)) { return Refusal{Code::dead, {a}}; }
  if (!brep.alive(b)) { return Refusal{Code::dead, {b}}; }
  if (brep.vertex(a) != brep.vertex(b)) { return Refusal{Code::different_vertices, {a, b}}; }
  if (detail::Raw::halfedges(brep).full()) { return Refusal{Code::full, {}}; }
  return unchecked::split_vertex(brep, a, b);
}

// Contracts the edge of h into the vertex where it starts, and returns that vertex.         counts: v-1 e-1
// Textbook: kev.
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
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  if (brep.vertex(h) == brep.target(h)) { return Refusal{Code::same_vertex, {h, brep.vertex(h)}}; }
  if (brep.next(h) == twin(h) && brep.prev(h) == twin(h)) { return Refusal{Code::last_edge, {h}}; }
  return unchecked::join_vertices(brep, h);
}

// Puts a new vertex m on the edge of h; h keeps its start, the result is n = next(h).        counts: v+1 e+1
//
//      a ------h------> b    ==>    a ---h---> m ---n---> b        m = vertex(n) has default data.
//
// The special case of split_vertex (mev) at b where twin(h) alone changes its vertex: twin(h) runs m -> a afterwards.
// Refused (nothing changes): h is dead.     Inverse: join_vertices(twin(n)).     Time: O(1).
template <class B>
Result<HalfedgeId> split_edge(B& brep, HalfedgeId h) {
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  if (detail::Raw::halfedges(brep).full()) { return Refusal{Code::full, {}}; }
  return unchecked::split_edge(brep, h);
}

// Inserts the edge a.vertex - b.vertex between two faces, which become one face with one loop.   counts: e+1 f-1 (s-1 or h+1)
// Textbook: kfmrh, which makes the loop of one face a second loop (a ring) of the other, and then mekr, which joins the two loops.
//
//      *-------*    *-------*         *-------*    *-------*
//      |       |    |       |         |       |    |       |      new edge h runs a.vertex -> b.vertex: next(h) = b,
//      |   f   a    b   g   |   ==>   |       *-h->*       |      next(twin(h)) = a; face(a) stays, face(b) is killed.
//      *-------*    *-------*         *-------*    *-------*      (The faces are the outsides of what is drawn.)
//
// Faces of two shells: the shells become one. Faces of one shell: the shell gets a handle.
// Refused (nothing changes): a or b is dead; they lie on the same face.     Inverse: cut(h).     Time: the edges of face(b).
template <class B>
Result<HalfedgeId> bridge(B& brep, HalfedgeId a, HalfedgeId b) {
  if (!brep.alive(a)) { return Refusal{Code::dead, {a}}; }
  if (!brep.alive(b)) { return Refusal{Code::dead, {b}}; }
  if (brep.face(a) == brep.face(b)) { return Refusal{Code::one_face, {a, b}}; }
  if (detail::Raw::halfedges(brep).full()) { return Refusal{Code::full, {}}; }
  return unchecked::bridge(brep, a, b);
}

// Removes an edge that has the same face on both sides; its loop falls into two, and each becomes a face.   counts: e-1 f+1
// Textbook: kemr, which leaves a face with two loops, and then mfkrh, which makes a face of the second.
// The loop at vertex(h) keeps the face, the loop at target(h) gets the new face, which is returned. Either the shell falls into two or
// it loses a handle (drawing: bridge, read backwards).
//
// Refused (nothing changes): h is dead; its sides are different faces; an end of h is the end of a spur: no edge would be left there.
// Inverse: bridge(next(twin(h)), next(h)), read before.     Time: the edges of the new face.
template <class B>
Result<FaceId> cut(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h);
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  if (brep.face(h) != brep.face(t)) { return Refusal{Code::two_faces, {h}}; }
  if (brep.next(h) == t) { return Refusal{Code::spur, {h, brep.vertex(t)}}; }
  if (brep.next(t) == h) { return Refusal{Code::spur, {h, brep.vertex(h)}}; }
  return unchecked::cut(brep, h);
}

// Unites two vertices by a new loop edge, the dual of bridge.                                       counts: v-1 e+1 (s-1 or h+1)
//
//      --*           *--          --*    .-h-.
//         \         /                 \  /  *-- \      new loop edge h at v = vertex(a): next(h) = a, next(twin(h)) = b.
//          v       w        ==>        v---<      )     v stays; w = vertex(b) is killed and what left it leaves v,
//         / a     b \                / a\  *-- /      inside the loop; face(a) and face(b) get one edge more.
//      --*           *--          --*    '---'
//
// Vertices of two shells: the shells become one. Vertices of one shell: the shell gets a handle.
// Refused (nothing changes): a or b is dead; they leave the same vertex.     Inverse: unweld(h).     Time: the edges of vertex(b).
template <class B>
Result<HalfedgeId> weld(B& brep, HalfedgeId a, HalfedgeId b) {
  if (!brep.alive(a)) { return Refusal{Code::dead, {a}}; }
  if (!brep.alive(b)) { return Refusal{Code::dead, {b}}; }
  if (brep.vertex(a) == brep.vertex(b)) { return Refusal{Code::one_vertex, {a, b}}; }
  if (detail::Raw::halfedges(brep).full()) { return Refusal{Code::full, {}}; }
  return unchecked::weld(brep, a, b);
}

// Contracts a loop edge; its vertex falls into two.                                                 counts: v+1 e-1 (s+1 or h-1)
// The half-edges from next(h) up to twin(h), clockwise, keep the vertex; those from next(twin(h)) up to h leave the new vertex,
// which is returned (drawing: weld, read backwards).
//
// Refused (nothing changes): h is dead; its ends differ; one of its sides is a face with this edge alone.
// Inverse: weld(next(h), next(twin(h))), read before.     Time: the half-edges of the new vertex.
template <class B>
Result<VertexId> unweld(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h);
  if (!brep.alive(h)) { return Refusal{Code::dead, {h}}; }
  if (brep.vertex(h) != brep.vertex(t)) { return Refusal{Code::two_vertices, {h}}; }
  if (brep.next(h) == h) { return Refusal{Code::one_edge_face, {h, brep.face(h)}}; }
  if (brep.next(t) == t) { return Refusal{Code::one_edge_face, {h, brep.face(t)}}; }
  return unchecked::unweld(brep, h);
}

// For two half-edges of one loop: is the way a -> b no longer than the way b -> a? Walks both at once, so it costs the
// shorter way only. split_face(a, b) relabels the first way, split_face(b, a) the second; a caller who does not mind which
// side gets the new name asks here and cuts a loop of n edges in O(shorter side).
template <class B>
[[nodiscard]] bool first_side_is_shorter(const B& brep, HalfedgeId a, HalfedgeId b) {
  if (a == b) { return true; }
  for (HalfedgeId x = a, y = b;;) {
    x = brep.next(x);
    if (x == b) { return true; }
    y = brep.next(y);
    if (y == a) { return false; }
  }
}

}  // namespace brep
