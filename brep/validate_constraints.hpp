// SPDX-License-Identifier: MIT
#pragma once

// What an algorithm may want beyond a valid structure. A spur is a valid structure and a nuisance to a triangulator; so these
// rules are asked for one by one, and they are looked at only where R1 to R8 hold (validate.hpp).
//
//   R9   no spurs: at least two half-edges leave each vertex
//   R10  no loops: the ends of each edge differ
//   R11  each face has at least three edges
//   R12  no vertex lies twice on a face
//   R13  the two sides of each edge are different faces
//   R14  no two edges have the same ends
//   R15  at least three edges meet at each vertex
//
//   validate(brep, Constraint::no_loops | Constraint::three_edges)
//
// Each set has linear time and memory.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <brep/circulators.hpp>
#include <brep/validate.hpp>

namespace brep {

// A set of rules: the bit of a rule is its number.
enum class Constraint : std::uint32_t {
  no_spurs = 1u << 9,
  no_loops = 1u << 10,
  three_edges = 1u << 11,
  vertex_once_on_face = 1u << 12,
  two_faces_at_edge = 1u << 13,
  one_edge_between_vertices = 1u << 14,
  three_edges_at_vertex = 1u << 15,
  polygons = no_spurs | no_loops | three_edges | vertex_once_on_face,  // each face is a simple polygon
  polyhedron = 0xfe00,                                                 // all: what the boundary of a convex polyhedron keeps
};
[[nodiscard]] constexpr Constraint operator|(Constraint a, Constraint b) {
  return static_cast<Constraint>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
[[nodiscard]] constexpr bool contains(Constraint set, Constraint rule) {
  return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(rule)) != 0;
}

namespace detail {

template <class B>
void check_vertices(const B& brep, Constraint set, std::vector<Fault>& faults) {
  std::vector<VertexId> reached_from(brep.vertex_end());
  std::vector<HalfedgeId> by(brep.vertex_end());
  for (VertexId v : vertices(brep)) {
    const std::size_t n = degree(brep, v);
    if (n < 2 && contains(set, Constraint::no_spurs)) {
      const HalfedgeId h = brep.halfedge(v);
      faults.push_back(fault(9, {v, h},
                             to_string(v) + " is the end of a spur: only " + to_string(h) + " leaves it; join_vertices(" +
                                 to_string(twin(h)) + ") takes it away"));
    }
    if (n < 3 && contains(set, Constraint::three_edges_at_vertex)) {
      faults.push_back(fault(15, {v},
                             "only " + std::to_string(n) + " half-edges leave " + to_string(v) +
                                 "; usually a T-vertex, or what is left after edges were removed"));
    }
    if (!contains(set, Constraint::one_edge_between_vertices)) { continue; }
    for (HalfedgeId h : halfedges_from(brep, v)) {
      const VertexId w = brep.target(h);
      if (w <= v) {
        continue;  // each pair once; loops are R10
      }
      if (reached_from[w.index] == v) {
        faults.push_back(fault(14, {edge(by[w.index]), edge(h), v, w},
                               to_string(edge(by[w.index])) + " and " + to_string(edge(h)) + " both join " + to_string(v) + " and " +
                                   to_string(w) + "; usually a face with two edges, or a handle that is too coarse"));
      }
      reached_from[w.index] = v;
      by[w.index] = h;
    }
  }
}

template <class B>
void check_edges(const B& brep, Constraint set, std::vector<Fault>& faults) {
  for (EdgeId e : edges(brep)) {
    const HalfedgeId h = halfedge(e);
    if (contains(set, Constraint::no_loops) && brep.vertex(h) == brep.target(h)) {
      faults.push_back(fault(10, {e, brep.vertex(h)},
                             to_string(e) + " is a loop: both its ends are " + to_string(brep.vertex(h)) +
                                 "; usually an edge whose other side was contracted"));
    }
    if (contains(set, Constraint::two_faces_at_edge) && brep.face(h) == brep.face(twin(h))) {
      faults.push_back(fault(13, {e, brep.face(h)},
                             to_string(e) + " has " + to_string(brep.face(h)) +
                                 " on both sides; a bridge or a spur: join_faces cannot take it away, cut or join_vertices can"));
    }
  }
}

template <class B>
void check_faces(const B& brep, Constraint set, std::vector<Fault>& faults) {
  std::vector<FaceId> lies_on(brep.vertex_end());
  for (FaceId f : faces(brep)) {
    std::size_t n = 0;
    for (HalfedgeId h : halfedges_of(brep, f)) {
      ++n;
      const VertexId v = brep.vertex(h);
      if (contains(set, Constraint::vertex_once_on_face) && lies_on[v.index] == f) {
        faults.push_back(fault(12, {v, f, h},
                               to_string(v) + " lies on " + to_string(f) + " more than once, again where " + to_string(h) +
                                   " starts; usually a bridge to a hole, or a spur"));
      }
      lies_on[v.index] = f;
    }
    if (n < 3 && contains(set, Constraint::three_edges)) {
      faults.push_back(fault(11, {f},
                             to_string(f) + " has only " + std::to_string(n) +
                                 " edges; usually what is left of a face whose edges were contracted: join_faces removes it"));
    }
  }
}

}  // namespace detail

// The faults of the structure; where there are none, those of the constraints in the set.
template <class B>
[[nodiscard]] std::vector<Fault> validate(const B& brep, Constraint set) {
  std::vector<Fault> faults = validate(brep);
  if (!faults.empty()) { return faults; }
  detail::check_vertices(brep, set, faults);
  detail::check_edges(brep, set, faults);
  detail::check_faces(brep, set, faults);
  return faults;
}

}  // namespace brep
