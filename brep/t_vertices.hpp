// SPDX-License-Identifier: MIT
#pragma once

// T-vertices by level tags (paper 2.2, 4.4): split object AtTVertex, condition object NoTVertices, and the elimination before shading.
//
// By the level rule (refine.hpp) a vertex of higher level on the loop of a face of level l is a T-vertex, put there by a finer
// neighbour; so the faces across both its edges have a level above l too. A cut inside the face has parts of level l on both sides: a
// vertex where a cut ends has such a part beside it and is a corner from then on. No coordinates are compared, nothing is stored.
//
// Elimination connects each T-vertex to the nearest corner of its face. It usually lies on a straight edge: a cut to a corner on the
// same line is refused as degenerate, and the next nearest corner is taken. What remains are triangles and quadrilaterals,
// positively oriented and without straight corners; a face of five or more corners is cut on by its best diagonals.
// The level of the finished parts is raised to the highest level among their vertices, so that by the tags too no T-vertex
// is left. Regular refinement cannot go on after that: eliminate when the mesh is final.

#include <algorithm>
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>

#include <brep/circulators.hpp>
#include <brep/conditions.hpp>
#include <brep/outline.hpp>
#include <brep/split.hpp>

namespace brep {

// Is the start of h a T-vertex of the face of h, that is not yet connected?
template <class B>
[[nodiscard]] bool is_t_vertex(const B& brep, HalfedgeId h) {
  const auto level = brep.data(brep.face(h)).level;
  return brep.data(brep.vertex(h)).level > level && brep.data(brep.face(twin(h))).level > level &&
         brep.data(brep.face(twin(brep.prev(h)))).level > level;
}

// Condition object: the loop has no T-vertex.
struct NoTVertices {
  using condition_object = NoTVertices;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    for (HalfedgeId h : halfedges_of(brep, f)) {
      if (is_t_vertex(brep, h)) { return false; }
    }
    return true;
  }
};

// Split object: the first T-vertex that an inner diagonal connects to a corner, with the nearest such corner.
struct AtTVertex {
  template <class B>
  Cut operator()(const B& brep, FaceId f) const {
    if (NoTVertices{}(brep, f)) { return {}; }
    const auto loop = detail::loop_of(brep, f);
    const auto points = positions(brep, f);
    const Outline outline(points);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (!is_t_vertex(brep, loop[i])) { continue; }
      std::optional<std::size_t> nearest;
      for (std::size_t j = 0; j < loop.size(); ++j) {
        if (is_t_vertex(brep, loop[j])) { continue; }
        if (nearest && glm::distance(points[i], points[j]) >= glm::distance(points[i], points[*nearest])) { continue; }
        if (outline.inner_diagonal(i, j)) { nearest = j; }
      }
      if (nearest) { return {loop[i], loop[*nearest]}; }
    }
    return {};
  }
};

// Eliminates the T-vertices of the living face f and returns the number of new faces; they have f's data, level apart. Faces that
// are finished as they are keep everything. Meant for convex faces; others with area are cut into simple parts all the same.
// When no handle is left, nothing changes.
template <class B>
std::size_t eliminate_t_vertices(B& brep, FaceId f) {
  const auto split = first_of(AtTVertex{}, NiceSplit{}, AtLeastOverlap{normal(brep, f)});
  const auto parts = split_recursively(brep, f, split, triangles || (quadrangles && NoTVertices{} && StrictlyConvex{}));
  if (!parts || parts->faces.size() == 1) { return 0; }
  for (FaceId part : parts->faces) {
    auto& level = brep.data(part).level;
    for (HalfedgeId h : halfedges_of(brep, part)) { level = std::max(level, brep.data(brep.vertex(h)).level); }
  }
  return parts->faces.size() - 1;
}

}  // namespace brep
