// SPDX-License-Identifier: MIT
#pragma once

// The four changes of links below the Euler operators, and the two walks that rename.
//
// An edge can be inserted between two corners of faces or deleted, and it can grow between two half-edges of vertices or be
// contracted. The links do not know whether that splits a loop or merges two: insert_edge does both split_face and bridge, delete_edge
// join_faces and cut, expand_edge split_vertex and weld, contract_edge join_vertices and unweld. The two of each pair differ in which
// half-edges get a new face or vertex. The caller writes the records of faces and vertices, the anchors and the labels.

#include <brep/brep.hpp>

namespace brep::detail {

template <class B>
void link(B& brep, HalfedgeId before, HalfedgeId after) {
  Raw::at(brep, before).next = after;
  Raw::at(brep, after).prev = before;
}

// The labels of a new edge. (Each word is stored by itself, here and in link: measured faster than whole records, which the compiler puts
// together in vector registers.)
template <class B>
void label(B& brep, HalfedgeId h, VertexId v, FaceId f, VertexId w, FaceId g) {
  Raw::at(brep, h).vertex = v;
  Raw::at(brep, twin(h)).vertex = w;
  Raw::at(brep, h).face = f;
  Raw::at(brep, twin(h)).face = g;
}

// h runs from vertex(a) to vertex(b), in the corners before a and before b.  before_a -> h -> b,  before_b -> twin(h) -> a.
// For a == b twin(h) is alone on its loop. Labels of h: of a's vertex, of b's face; of twin(h): of b's vertex, face g.
template <class B>
void insert_edge(B& brep, HalfedgeId h, HalfedgeId a, HalfedgeId b, FaceId g) {
  const HalfedgeId t = twin(h), before_a = brep.prev(a), before_b = brep.prev(b);
  const VertexId v = brep.vertex(a), w = brep.vertex(b);
  const FaceId f = brep.face(b);
  link(brep, before_a, h);
  link(brep, h, b);
  a == b ? link(brep, t, t) : (link(brep, before_b, t), link(brep, t, a));
  label(brep, h, v, f, w, g);
}

// What delete_edge links anew: the half-edges that follow at the two ends.
struct Ends {
  HalfedgeId at_origin, at_target;
};

// Takes h and its twin out of their loops; neither end is the end of a spur, and not both are alone.
// insert_edge(h, at_origin, at_target) is the inverse; where h was alone, with twin(h) in place of h.
template <class B>
[[gnu::always_inline]] inline Ends delete_edge(B& brep, HalfedgeId h) {
  const HalfedgeId t = twin(h);
  const HalfedgeId before_h = brep.prev(h), after_h = brep.next(h), before_t = brep.prev(t), after_t = brep.next(t);
  const bool h_alone = after_h == h, t_alone = after_t == t;
  const Ends ends{t_alone ? after_h : after_t, h_alone ? after_t : after_h};
  const HalfedgeId to_origin = h_alone ? before_t : before_h, to_target = t_alone ? before_h : before_t;
  link(brep, to_origin, ends.at_origin);
  link(brep, to_target, ends.at_target);
  return ends;
}

// h grows before a and its twin before b: before_a -> h -> a,  before_b -> twin(h) -> b.
// For a == b they make a spur before a: before_a -> h -> twin(h) -> a. Labels of h: of b's vertex, of a's face; of twin(h): of b's face,
// vertex w.
template <class B>
void expand_edge(B& brep, HalfedgeId h, HalfedgeId a, HalfedgeId b, VertexId w) {
  const HalfedgeId t = twin(h), before_a = brep.prev(a), before_b = brep.prev(b);
  const VertexId v = brep.vertex(b);
  const FaceId f = brep.face(a), g = brep.face(b);
  link(brep, before_a, h);
  a == b ? link(brep, h, t) : (link(brep, h, a), link(brep, before_b, t));
  link(brep, t, b);
  label(brep, h, v, f, w, g);
}

// Takes h and its twin out of the loops of their faces; neither is alone on its loop, and the edge is no segment.
// expand_edge(h, next(h), next(twin(h))) is the inverse; for a spur with the one of the two that stays, twice.
template <class B>
void contract_edge(B& brep, HalfedgeId h) {
  for (HalfedgeId x : {h, twin(h)}) { link(brep, brep.prev(x), brep.next(x)); }
}

// Names f as the face of all half-edges from `first` up to `last`, which is not renamed; first == last renames the whole loop.
// Tells whether `watched` was among them.
template <class B>
bool rename_loop(B& brep, HalfedgeId first, HalfedgeId last, FaceId f, HalfedgeId watched = {}) {
  bool met = false;
  HalfedgeId x = first;
  do {
    met = met || x == watched;
    auto& record = Raw::at(brep, x);
    record.face = f;
    x = record.next;
  } while (x != last);
  return met;
}

// The same around a vertex, clockwise.
template <class B>
bool rename_orbit(B& brep, HalfedgeId first, HalfedgeId last, VertexId v, HalfedgeId watched = {}) {
  bool met = false;
  HalfedgeId x = first;
  do {
    met = met || x == watched;
    Raw::at(brep, x).vertex = v;
    x = brep.next(twin(x));
  } while (x != last);
  return met;
}

}  // namespace brep::detail
