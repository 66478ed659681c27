// SPDX-License-Identifier: MIT
#pragma once

// T-vertex elimination (paper 4.4): before shading, each T-vertex is connected to the nearest corner of its face.
//
// By the level rule a T-vertex of a face of level l is a vertex of higher level on its loop. Once connected it is a corner of all
// parts of the face. It usually lies on a straight edge: a cut to a corner on the same line is refused as degenerate, and the
// next nearest corner is taken. What remains are triangles and quadrilaterals, positively oriented and without straight
// corners; a face of five or more corners is cut on by its best diagonals.
// The level of the finished parts is raised to the highest level among their vertices, so that by the tags too no T-vertex
// is left. Regular refinement cannot go on after that: eliminate when the mesh is final.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/circulators.hpp>
#include <brep/outline.hpp>
#include <brep/split.hpp>

namespace brep {

// Split object and condition object in one: at a T-vertex of a face whose level was `level`, then at the best diagonal.
class TVertices {
 public:
  explicit TVertices(unsigned level) : level_(level) {}

  // Condition: a triangle or quadrilateral without T-vertices and without straight or non-convex corners.
  template <class B>
  [[nodiscard]] bool operator()(const B& brep, FaceId f) const {
    std::size_t n = 0;
    bool waiting = false;
    for (HalfedgeId h : halfedges_of(brep, f)) {
      if (++n > 4) return false;
      waiting = waiting || pending(brep, brep.vertex(h));
    }
    if (n < 4) return true;
    if (waiting) return false;
    const Outline outline{Polygon(positions(brep, f))};
    for (std::size_t i = 0; i < 4; ++i) {
      if (outline.turn(i) < 1e-9) return false;
    }
    return true;
  }

  // Split: the first T-vertex that can be connected to a corner, with the nearest such corner; else the best diagonal; for a
  // face so warped that none is found, the cut whose smaller part has the largest signed area.
  template <class B>
  [[nodiscard]] Cut cut(const B& brep, FaceId f) {
    const auto loop = detail::loop_of(brep, f);
    const auto points = positions(brep, f);
    const Outline outline(points);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (!pending(brep, brep.vertex(loop[i]))) continue;
      std::optional<std::size_t> nearest;
      for (std::size_t j = 0; j < loop.size(); ++j) {
        if (pending(brep, brep.vertex(loop[j]))) continue;
        if (nearest && glm::distance(points[i], points[j]) >= glm::distance(points[i], points[*nearest])) continue;
        if (outline.inner_diagonal(i, j)) nearest = j;
      }
      if (nearest) return connect(brep, loop[i], loop[*nearest]);
    }
    if (const auto diagonal = outline.best_diagonal()) return connect(brep, loop[diagonal->first], loop[diagonal->second]);
    if (loop.size() < 4) return {};
    Cut best{loop[0], loop[2]};
    double best_area = -HUGE_VAL;
    const glm::dvec3 n = normal(points);
    for (std::size_t i = 0; i < loop.size(); ++i) {  // cut off the ear i, i + 1, i + 2
      const std::size_t j = outline.next(i), k = outline.next(j);
      const double ear = 0.5 * glm::dot(glm::cross(points[j] - points[i], points[k] - points[i]), n);
      const double smaller = std::fmin(ear, area(points) - ear);
      if (smaller <= best_area) continue;
      best_area = smaller;
      best = {loop[i], loop[k]};
    }
    return connect(brep, best.a, best.b);
  }

 private:
  template <class B>
  [[nodiscard]] bool pending(const B& brep, VertexId v) const {
    if (brep.data(v).level <= level_) return false;
    for (VertexId w : connected_) {
      if (w == v) return false;
    }
    return true;
  }
  template <class B>
  Cut connect(const B& brep, HalfedgeId a, HalfedgeId b) {
    for (HalfedgeId h : {a, b}) {
      if (pending(brep, brep.vertex(h))) connected_.push_back(brep.vertex(h));
    }
    return {a, b};
  }

  unsigned level_;
  SmallList<VertexId, 32> connected_;
};

// Eliminates the T-vertices of the living face f and returns the number of new faces; they have f's data, level apart. Faces that
// are finished as they are keep everything. Meant for convex faces; others with area are cut into simple parts all the same.
template <class B>
std::size_t eliminate_t_vertices(B& brep, FaceId f) {
  TVertices t_vertices(brep.data(f).level);
  std::vector<HalfedgeId> cuts;
  const auto split = [&](const B& b, FaceId part) { return t_vertices.cut(b, part); };
  const auto finished = [&](const B& b, FaceId part) { return t_vertices(b, part); };
  const std::vector<FaceId> parts = split_recursively(brep, f, split, finished, cuts);
  if (parts.size() == 1) return 0;
  for (FaceId part : parts) {
    auto& level = brep.data(part).level;
    for (HalfedgeId h : halfedges_of(brep, part)) level = std::max(level, brep.data(brep.vertex(h)).level);
  }
  return parts.size() - 1;
}

}  // namespace brep
