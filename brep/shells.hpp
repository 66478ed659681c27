// SPDX-License-Identifier: MIT
#pragma once

// The connected components of a BRep, called shells, each with its counts and its genus (paper 2.1).
//
// No shell is stored anywhere: they are found by flood fill when asked for. A shell is named by its half-edge of lowest index. Within a
// shell v - e + f = 2 - 2 genus: the genus is the number of its handles, 0 for what can be blown up to a sphere, 1 for a torus.

#include <cstddef>
#include <vector>

#include <brep/circulators.hpp>

namespace brep {

struct Shell {
  HalfedgeId halfedge;  // the one of lowest index
  std::size_t vertices = 0, edges = 0, faces = 0;

  [[nodiscard]] std::size_t genus() const { return (2 + edges - vertices - faces) / 2; }
};

namespace detail {

// Visits the half-edges that can be reached from h by next and twin, h first, each once; both halves of an edge come together.
template <class B, class Visit>
void flood(const B& brep, HalfedgeId h, std::vector<bool>& seen, Visit&& visit) {  // seen: by edge
  std::vector<HalfedgeId> waiting;
  const auto reach = [&](HalfedgeId x) {
    if (seen[edge(x).index]) { return; }
    seen[edge(x).index] = true;
    waiting.push_back(x);
  };
  reach(h);
  while (!waiting.empty()) {
    const HalfedgeId x = waiting.back();
    waiting.pop_back();
    visit(x);
    visit(twin(x));
    reach(brep.next(x));
    reach(brep.next(twin(x)));
  }
}

}  // namespace detail

// All shells, by rising half-edge. O(v + e + f) time and memory.
template <class B>
[[nodiscard]] std::vector<Shell> shells(const B& brep) {
  std::vector<bool> seen(brep.edge_end(), false);
  std::vector<Shell> result;
  for (EdgeId e : edges(brep)) {
    if (seen[e.index]) { continue; }
    Shell shell{halfedge(e)};
    std::size_t halves = 0;
    detail::flood(brep, halfedge(e), seen, [&](HalfedgeId h) {
      ++halves;
      if (brep.halfedge(brep.vertex(h)) == h) {
        ++shell.vertices;  // every vertex and every face has one anchor
      }
      if (brep.halfedge(brep.face(h)) == h) { ++shell.faces; }
    });
    shell.edges = halves / 2;
    result.push_back(shell);
  }
  return result;
}

// All half-edges of the shell of h, h first, both halves of an edge behind one another. Time O(half-edges of the shell), memory O(e) bits.
template <class B>
[[nodiscard]] std::vector<HalfedgeId> halfedges_of_shell(const B& brep, HalfedgeId h) {
  std::vector<bool> seen(brep.edge_end(), false);
  std::vector<HalfedgeId> result;
  detail::flood(brep, h, seen, [&](HalfedgeId x) { result.push_back(x); });
  return result;
}
// All faces of the shell of h, each once.
template <class B>
[[nodiscard]] std::vector<FaceId> faces_of_shell(const B& brep, HalfedgeId h) {
  std::vector<bool> seen(brep.edge_end(), false);
  std::vector<FaceId> result;
  detail::flood(brep, h, seen, [&](HalfedgeId x) {
    if (brep.halfedge(brep.face(x)) == x) { result.push_back(brep.face(x)); }
  });
  return result;
}
// All vertices of the shell of h, each once.
template <class B>
[[nodiscard]] std::vector<VertexId> vertices_of_shell(const B& brep, HalfedgeId h) {
  std::vector<bool> seen(brep.edge_end(), false);
  std::vector<VertexId> result;
  detail::flood(brep, h, seen, [&](HalfedgeId x) {
    if (brep.halfedge(brep.vertex(x)) == x) { result.push_back(brep.vertex(x)); }
  });
  return result;
}

}  // namespace brep
