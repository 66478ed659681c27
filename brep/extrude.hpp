// SPDX-License-Identifier: MIT
#pragma once

// Composite operators on one face: extrude and poke. Written with the operators of euler.hpp alone; everything is asked before
// anything is changed, so a refusal changes nothing.
//
// They are topology. Where the new vertices lie is said by a callable, asked when the new topology stands; without one, and if vertices
// have a `position`, an extruded vertex lies on the old one, and the vertex of a poked face in its centroid. Faces of any degree will
// do, with spurs and repeated vertices: each corner of the loop is treated on its own. New faces inherit from f (inherit.hpp).

#include <concepts>
#include <cstddef>
#include <type_traits>

#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/geometry.hpp>
#include <brep/result.hpp>
#include <brep/small_list.hpp>

namespace brep {

namespace detail {

// Can so many edges be made?
template <class B>
[[nodiscard]] bool has_room(const B& brep, std::size_t edges) {
  const auto& pool = Raw::halfedges(brep);
  using Pool = std::remove_cvref_t<decltype(pool)>;
  return edges <= (Pool::end_of_list - pool.size()) / 2 - 1 + pool.size() / 2 - pool.count();
}

template <class B>
concept Placed = requires(typename B::vertex_type& data) {
  data.position;
};

}  // namespace detail

// Lifts f off on a collar of quadrilaterals, one for each of its n edges; f is the cap.               counts: v+n e+2n f+n
//
//      *-------*         *-------*       f keeps its handle; its loop is new, with the anchor above the old one. The side
//      |       |         |\     /|       below a half-edge x of the cap is face(twin(x)), whose next(next(twin(x))) is the old
//      |   f   |   ==>   | *---* |       half-edge there.
//      |       |         | | f | |
//      |       |         | *---* |       place(brep, new vertex, old vertex) is called for each corner, in the order of the
//      *-------*         |/     \|       loop.
//                        *-------*       Returns the cap: f, or of a one-edge face the new face.
//
// Refused (nothing changes): f is dead; no handle is left.
// Inverse: join_faces for the n edges of the cap, last made first, then join_vertices for the n edges of the collar.
template <class B, std::invocable<B&, VertexId, VertexId> Place>
Result<FaceId> extrude_face(B& brep, FaceId f, Place&& place) {
  if (!brep.alive(f)) { return Refusal{Code::dead, {f}}; }
  SmallList<HalfedgeId> loop;
  for (HalfedgeId h : halfedges_of(brep, f)) { loop.push_back(h); }
  const std::size_t n = loop.size();
  if (!detail::has_room(brep, 2 * n)) { return Refusal{Code::full, {}}; }
  SmallList<HalfedgeId> down;  // from the new vertices
  for (HalfedgeId h : loop) { down.push_back(twin(unchecked::split_vertex(brep, h, h))); }
  HalfedgeId first{}, last{};
  for (std::size_t i = 0; i < n; ++i) {
    last = unchecked::split_face(brep, down[i], i + 1 < n ? down[i + 1] : i > 0 ? first : down[0]);
    if (i == 0) { first = last; }
  }
  for (std::size_t i = 0; i < n; ++i) { place(brep, brep.vertex(down[i]), brep.vertex(loop[i])); }
  return n > 1 ? f : brep.face(twin(last));
}
template <class B>
Result<FaceId> extrude_face(B& brep, FaceId f) {
  return extrude_face(brep, f, [](B& b, VertexId lifted, VertexId base) {
    if constexpr (detail::Placed<B>) { b.data(lifted).position = b.data(base).position; }
  });
}
// All vertices of the cap moved by `offset`.
template <detail::Placed B>
Result<FaceId> extrude_face(B& brep, FaceId f, const glm::dvec3& offset) {
  return extrude_face(brep, f, [&](B& b, VertexId lifted, VertexId base) { b.data(lifted).position = b.data(base).position + offset; });
}

// Puts a new vertex into f and joins it to all n corners; f falls into n triangles.                    counts: v+1 e+n f+n-1
//
//      *-------*         *-------*
//      |       |         |\     /|       f stays as the triangle at the last half-edge of its loop (the one before the
//      |   f   |   ==>   |  >*<  |       anchor). Returns the new vertex.
//      |       |         |/     \|
//      *-------*         *-------*       place(brep, vertex) is called once.
//
// Refused (nothing changes): f is dead; no handle is left.
// Inverse: join_faces for the spokes, last made first, but the first one; then join_vertices(h) for that, h ending at the vertex.
template <class B, std::invocable<B&, VertexId> Place>
Result<VertexId> poke_face(B& brep, FaceId f, Place&& place) {
  if (!brep.alive(f)) { return Refusal{Code::dead, {f}}; }
  SmallList<HalfedgeId> loop;
  for (HalfedgeId h : halfedges_of(brep, f)) { loop.push_back(h); }
  if (!detail::has_room(brep, loop.size())) { return Refusal{Code::full, {}}; }
  HalfedgeId spoke = twin(unchecked::split_vertex(brep, loop[0], loop[0]));  // from the new vertex
  const VertexId centre = brep.vertex(spoke);
  for (std::size_t i = 1; i < loop.size(); ++i) { spoke = unchecked::split_face(brep, spoke, loop[i]); }
  place(brep, centre);
  return centre;
}
template <class B>
Result<VertexId> poke_face(B& brep, FaceId f) {
  if constexpr (detail::Placed<B>) {
    const glm::dvec3 middle = brep.alive(f) ? centroid(brep, f) : glm::dvec3{0.0};
    return poke_face(brep, f, [&](B& b, VertexId centre) { b.data(centre).position = middle; });
  } else {
    return poke_face(brep, f, [](B&, VertexId) {});
  }
}

}  // namespace brep
