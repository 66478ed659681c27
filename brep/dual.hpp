// SPDX-License-Identifier: MIT
#pragma once

// The dual of a BRep: faces and vertices exchanged (paper 2.1: "the dual graph is revealed by exchanging vertices and faces").
//
// The dual of face f is vertex VertexId{f.index}, that of vertex v is FaceId{v.index}; half-edges keep their handles, turned by a
// quarter: the dual of h starts at face(h), ends at face(twin(h)) and has target(h) on its left:
//
//            w                          next*(h)   = prev(twin(h))        v* = f,  e* = e,  f* = v
//        f   |h   g       f --h*--> g   vertex*(h) = face(h)              s and genus stay
//            v                          face*(h)   = target(h)
//
// The dual of the dual has every half-edge with the roles of its ends exchanged, so twin leads back: it is the same map. What is true
// of split_face on m is true of split_vertex on dual(m); the tests live on it.

#include <cstdint>
#include <type_traits>

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>

namespace brep {

// The dual as a new BRep of type D, all data default but for `position`, if both have it: a vertex of the dual lies in the centroid of its
// face. Slots that are free in `brep` are free in the dual. Linear time. A log in D is empty.
template <class D, class B>
[[nodiscard]] D dual(const B& brep) {
  using detail::Raw;
  D result;
  for (std::uint32_t e = 0; e < brep.edge_end(); ++e) (void)Raw::new_edge(result);
  for (std::uint32_t f = 0; f < brep.face_end(); ++f) (void)Raw::new_vertex(result);
  for (std::uint32_t v = 0; v < brep.vertex_end(); ++v) (void)Raw::new_face(result);
  for (EdgeId e : edges(brep)) {
    for (HalfedgeId h : {halfedge(e), twin(halfedge(e))}) {
      Raw::at(result, h) = {brep.prev(twin(h)), twin(brep.next(h)), VertexId{brep.face(h).index}, FaceId{brep.target(h).index}};
    }
  }
  for (FaceId f : faces(brep)) {
    const VertexId v{f.index};
    Raw::at(result, v).halfedge = brep.halfedge(f);
    if constexpr (requires { result.data(v).position = brep.data(VertexId{}).position; }) result.data(v).position = centroid(brep, f);
  }
  for (VertexId v : vertices(brep)) Raw::at(result, FaceId{v.index}).halfedge = twin(brep.halfedge(v));
  // Free slots, such that the lowest one is given out first.
  for (std::uint32_t e = brep.edge_end(); e-- > 0;) {
    if (!brep.alive(EdgeId{e})) Raw::halfedges(result).release(2 * e);
  }
  for (std::uint32_t f = brep.face_end(); f-- > 0;) {
    if (!brep.alive(FaceId{f})) Raw::vertices(result).release(f);
  }
  for (std::uint32_t v = brep.vertex_end(); v-- > 0;) {
    if (!brep.alive(VertexId{v})) Raw::faces(result).release(v);
  }
  return result;
}
template <class B>
[[nodiscard]] B dual(const B& brep) {
  return dual<B, B>(brep);
}

}  // namespace brep
