// SPDX-License-Identifier: MIT
#pragma once

// The Euler operators without the checks: for hot loops where the caller knows that the request is possible. The contracts, the
// drawings and the refusals stand in euler.hpp; a request that is refused there leaves a broken BRep behind here.
//
// Every operator is a change of links (surgery.hpp), a renaming on one side, and the choice of anchors. An anchor is kept where
// possible. When a face (vertex) is split and its anchor ends up on the new face (vertex), the half-edge becomes the anchor of the new
// one, and the old one gets another anchor. New elements are made in the order edge, vertex, face and killed in the opposite order: the
// log relies on it, because the pools hand slots out last in first out.

#include <brep/brep.hpp>
#include <brep/surgery.hpp>

namespace brep::unchecked {

using detail::Raw;

template <class B>
HalfedgeId make_segment(B& brep) {
  Raw::note(brep, Operator::make_segment, {}, {}, {});
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
  h = halfedge(edge(h));
  Raw::note(brep, Operator::kill_segment, h, {}, {});
  const VertexId v = brep.vertex(h), w = brep.target(h);
  Raw::kill(brep, brep.face(h));
  Raw::kill(brep, w);
  Raw::kill(brep, v);
  Raw::kill(brep, edge(h));
}

template <class B>
inline HalfedgeId split_face(B& brep, HalfedgeId a, HalfedgeId b) {
  Raw::note(brep, Operator::split_face, {}, a, b);
  const HalfedgeId h = Raw::new_edge(brep), t = twin(h);
  const FaceId f = brep.face(a), g = Raw::new_face(brep, f);
  detail::insert_edge(brep, h, a, b, g);
  const HalfedgeId anchor = brep.halfedge(f);
  const bool moved = a != b && detail::rename_loop(brep, a, t, g, anchor);
  Raw::at(brep, g).halfedge = moved ? anchor : t;
  if (moved) { Raw::at(brep, f).halfedge = h; }
  return h;
}

template <class B>
inline FaceId join_faces(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h), after_h = brep.next(h), after_t = brep.next(t);
  Raw::note(brep, Operator::join_faces, h, after_t == t ? after_h : after_t, after_h == h ? after_t : after_h, after_h == h);
  const FaceId f = brep.face(h), g = brep.face(t);
  const VertexId v = brep.vertex(h), w = brep.vertex(t);
  if (after_t != t) { detail::rename_loop(brep, after_t, t, f); }
  const detail::Ends ends = detail::delete_edge(brep, h);
  if (brep.halfedge(v) == h) { Raw::at(brep, v).halfedge = ends.at_origin; }
  if (brep.halfedge(w) == t) { Raw::at(brep, w).halfedge = ends.at_target; }
  if (brep.halfedge(f) == h) {
    const HalfedgeId other = brep.halfedge(g);
    Raw::at(brep, f).halfedge = other != t ? other : ends.at_target;
  }
  Raw::kill(brep, g);
  Raw::kill(brep, edge(h));
  return f;
}

template <class B>
inline HalfedgeId split_vertex(B& brep, HalfedgeId a, HalfedgeId b) {
  Raw::note(brep, Operator::split_vertex, {}, a, b);
  const HalfedgeId h = Raw::new_edge(brep), t = twin(h);
  const VertexId v = brep.vertex(a), w = Raw::new_vertex(brep, v);
  const HalfedgeId anchor = brep.halfedge(v);
  const bool moved = a != b && detail::rename_orbit(brep, a, b, w, anchor);
  detail::expand_edge(brep, h, a, b, w);
  Raw::at(brep, w).halfedge = moved ? anchor : t;
  if (moved) { Raw::at(brep, v).halfedge = h; }
  return h;
}

template <class B>
inline VertexId join_vertices(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h);
  // Where the walk goes on when h and t are taken out; on a spur t follows h, or h follows t.
  const HalfedgeId after_h = brep.next(h) == t ? brep.next(t) : brep.next(h);
  const HalfedgeId after_t = brep.next(t) == h ? brep.next(h) : brep.next(t);
  Raw::note(brep, Operator::join_vertices, h, after_h, after_t, brep.next(t) == h);
  const VertexId v = brep.vertex(h), w = brep.vertex(t);
  if (brep.next(h) != t) { detail::rename_orbit(brep, brep.next(h), t, v); }
  detail::contract_edge(brep, h);
  if (brep.halfedge(brep.face(h)) == h) { Raw::at(brep, brep.face(h)).halfedge = after_h; }
  if (brep.halfedge(brep.face(t)) == t) { Raw::at(brep, brep.face(t)).halfedge = after_t; }
  if (brep.halfedge(v) == h) {
    const HalfedgeId other = brep.halfedge(w);
    Raw::at(brep, v).halfedge = other != t ? other : after_t;
  }
  Raw::kill(brep, w);
  Raw::kill(brep, edge(h));
  return v;
}

template <class B>
inline HalfedgeId split_edge(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h);
  Raw::note(brep, Operator::split_edge, {}, h, t);
  const HalfedgeId back = Raw::new_edge(brep), n = twin(back);
  const VertexId b = brep.vertex(t), m = Raw::new_vertex(brep, b);
  const HalfedgeId after_h = brep.next(h);
  detail::link(brep, h, n);
  detail::link(brep, n, after_h);
  const HalfedgeId before_t = brep.prev(t);  // n itself when b was the end of a spur
  detail::link(brep, before_t, back);
  detail::link(brep, back, t);
  detail::label(brep, back, b, brep.face(t), m, brep.face(h));
  Raw::at(brep, t).vertex = m;
  const bool anchored = brep.halfedge(b) == t;
  Raw::at(brep, m).halfedge = anchored ? t : n;
  if (anchored) { Raw::at(brep, b).halfedge = back; }
  return n;
}

template <class B>
HalfedgeId bridge(B& brep, HalfedgeId a, HalfedgeId b) {
  Raw::note(brep, Operator::bridge, {}, a, b);
  const HalfedgeId h = Raw::new_edge(brep);
  const FaceId f = brep.face(a), g = brep.face(b);
  detail::rename_loop(brep, b, b, f);
  detail::insert_edge(brep, h, a, b, f);
  Raw::kill(brep, g);
  return h;
}

template <class B>
FaceId cut(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h);
  Raw::note(brep, Operator::cut, h, brep.next(t), brep.next(h));
  const FaceId f = brep.face(h), g = Raw::new_face(brep, f);
  const HalfedgeId anchor = brep.halfedge(f);
  const detail::Ends ends = detail::delete_edge(brep, h);
  const bool moved = detail::rename_loop(brep, ends.at_target, ends.at_target, g, anchor);
  Raw::at(brep, g).halfedge = moved ? anchor : ends.at_target;
  if (moved || anchor == h || anchor == t) { Raw::at(brep, f).halfedge = ends.at_origin; }
  if (brep.halfedge(brep.vertex(h)) == h) { Raw::at(brep, brep.vertex(h)).halfedge = ends.at_origin; }
  if (brep.halfedge(brep.vertex(t)) == t) { Raw::at(brep, brep.vertex(t)).halfedge = ends.at_target; }
  Raw::kill(brep, edge(h));
  return g;
}

template <class B>
HalfedgeId weld(B& brep, HalfedgeId a, HalfedgeId b) {
  Raw::note(brep, Operator::weld, {}, a, b);
  const HalfedgeId h = Raw::new_edge(brep);
  const VertexId v = brep.vertex(a), w = brep.vertex(b);
  detail::rename_orbit(brep, b, b, v);
  detail::expand_edge(brep, h, a, b, v);
  Raw::kill(brep, w);
  return h;
}

template <class B>
VertexId unweld(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h), a = brep.next(h), b = brep.next(t);
  Raw::note(brep, Operator::unweld, h, a, b);
  const VertexId v = brep.vertex(h), w = Raw::new_vertex(brep, v);
  const HalfedgeId anchor = brep.halfedge(v);
  detail::contract_edge(brep, h);
  const bool moved = detail::rename_orbit(brep, b, b, w, anchor);
  Raw::at(brep, w).halfedge = moved ? anchor : b;
  if (moved || anchor == h || anchor == t) { Raw::at(brep, v).halfedge = a; }
  if (brep.halfedge(brep.face(h)) == h) { Raw::at(brep, brep.face(h)).halfedge = a; }
  if (brep.halfedge(brep.face(t)) == t) { Raw::at(brep, brep.face(t)).halfedge = b; }
  Raw::kill(brep, edge(h));
  return w;
}

}  // namespace brep::unchecked
