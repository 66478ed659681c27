// SPDX-License-Identifier: MIT
#pragma once

// One step of a log: which operator was applied where, and the little that its inverse cannot know.
//
// 32 bytes a step. An operator that adds an edge is undone by its inverse; one that removes an edge is undone by its inverse
// with the old names. In both cases the anchors of the faces and vertices at the edge are put back as they were, because the
// operator had to choose others (euler_log.hpp).

#include <cstdint>

#include <brep/handles.hpp>

namespace brep {

// The rows of the table in euler_table.hpp, in its order.
enum class Operator : std::uint8_t {
  make_segment,
  kill_segment,
  split_face,
  join_faces,
  split_vertex,
  join_vertices,
  split_edge,
  bridge,
  cut,
  weld,
  unweld,
  set_anchor,
};

struct Step {
  Operator op{};
  bool alone = false;  // join_faces: h was a one-edge face; join_vertices: its origin was the end of a spur
  HalfedgeId h;        // the half-edge that was made, or that the operator was asked to remove; the new anchor
  HalfedgeId a, b;  // the arguments of an operator that adds an edge (split_edge: h and its twin), or those of the inverse; the old anchor
  // Anchors before, of the faces and vertices of a and b; of h and its twin where h is removed. Invalid where there was none.
  HalfedgeId face_a, face_b, vertex_a, vertex_b;
};
static_assert(sizeof(Step) == 32);

// The log of a BRep that keeps none: no memory, no time.
struct NoLog {
  template <class VertexT, class HalfedgeT, class FaceT, class Allocator>
  struct For {
    explicit For(const Allocator&) {}
    For(const For&, const Allocator&) {}
  };
};

}  // namespace brep
