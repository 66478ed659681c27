// SPDX-License-Identifier: MIT
#pragma once

// What lies around an element: ranges for range-for that allocate nothing (paper 2.2, "iterator classes").
//
//   of a face f    vertices_of(b, f)  edges_of(b, f)  neighbours_of(b, f)     in the order of halfedges_of(b, f)
//   of a vertex v  edges_of(b, v)     faces_of(b, v)  neighbours_of(b, v)     in the order of halfedges_from(b, v), clockwise
//   of an edge e   halfedges_of(e)    vertices_of(b, e)  faces_of(b, e)       two of each: start and left side of the first half first
//
// One entry for each half-edge of the walk. So in maps that are not simple an entry comes again: a vertex comes as often as the loop
// passes it, an edge with the face on both sides comes twice, a neighbour face as often as it shares an edge; a face is its own neighbour
// across a spur or a bridge, a vertex is its own neighbour along a loop edge. As with the walks below them, the topology must not
// change on the way.

#include <array>

#include <brep/circulators.hpp>

namespace brep {

namespace detail {

// What a walk shows of a half-edge.
struct ToVertex {
  template <class B>
  VertexId operator()(const B& brep, HalfedgeId h) const {
    return brep.vertex(h);
  }
};
struct ToTarget {
  template <class B>
  VertexId operator()(const B& brep, HalfedgeId h) const {
    return brep.target(h);
  }
};
struct ToEdge {
  template <class B>
  EdgeId operator()(const B&, HalfedgeId h) const {
    return edge(h);
  }
};
struct ToFace {
  template <class B>
  FaceId operator()(const B& brep, HalfedgeId h) const {
    return brep.face(h);
  }
};
struct ToOppositeFace {
  template <class B>
  FaceId operator()(const B& brep, HalfedgeId h) const {
    return brep.face(twin(h));
  }
};

}  // namespace detail

template <class B>
[[nodiscard]] auto vertices_of(const B& brep, FaceId f) {
  return detail::circle<detail::AroundFace, detail::ToVertex>(brep, brep.halfedge(f));
}
template <class B>
[[nodiscard]] auto edges_of(const B& brep, FaceId f) {
  return detail::circle<detail::AroundFace, detail::ToEdge>(brep, brep.halfedge(f));
}
// The faces on the other side of the edges of f.
template <class B>
[[nodiscard]] auto neighbours_of(const B& brep, FaceId f) {
  return detail::circle<detail::AroundFace, detail::ToOppositeFace>(brep, brep.halfedge(f));
}

template <class B>
[[nodiscard]] auto edges_of(const B& brep, VertexId v) {
  return detail::circle<detail::AroundVertex, detail::ToEdge>(brep, brep.halfedge(v));
}
// The face on the left of each half-edge that leaves v: one for each corner at v.
template <class B>
[[nodiscard]] auto faces_of(const B& brep, VertexId v) {
  return detail::circle<detail::AroundVertex, detail::ToFace>(brep, brep.halfedge(v));
}
// The vertices at the other ends of the edges of v.
template <class B>
[[nodiscard]] auto neighbours_of(const B& brep, VertexId v) {
  return detail::circle<detail::AroundVertex, detail::ToTarget>(brep, brep.halfedge(v));
}

[[nodiscard]] constexpr std::array<HalfedgeId, 2> halfedges_of(EdgeId e) { return {halfedge(e), twin(halfedge(e))}; }
template <class B>
[[nodiscard]] std::array<VertexId, 2> vertices_of(const B& brep, EdgeId e) {
  return {brep.vertex(halfedge(e)), brep.target(halfedge(e))};
}
template <class B>
[[nodiscard]] std::array<FaceId, 2> faces_of(const B& brep, EdgeId e) {
  return {brep.face(halfedge(e)), brep.face(twin(halfedge(e)))};
}

}  // namespace brep
