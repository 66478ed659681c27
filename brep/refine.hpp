// SPDX-License-Identifier: MIT
#pragma once

// Regular refinement by level tags (paper 4.4, fig. 4).
//
// Faces and vertices carry a split level (tag.hpp). The level rule: the corners of a face of level l have level <= l; a vertex of
// higher level on its loop is a T-vertex that a finer neighbour put there. To refine a face of level l, a vertex of
// level l + 1 between two of its corners is the mid-edge point; where two corners are adjacent the edge is split and the new vertex
// gets level l + 1. No coordinates are compared, and a face can be refined however often its neighbours were.
//
//      3---------2        3----*----2
//      |         |        | 3  | 2  |      a face of n >= 4 corners gives n quadrilaterals around its centroid,
//      |    f    |   ==>  *----*----*      a triangle four triangles, the last one in the middle.
//      |         |        | 0  | 1  |      Child k has the parent's corner k as its own corner 0.
//      0---------1        0----*----1
//
// The geometry is right for convex faces: their children are convex and cover them exactly. Everything is done by Euler
// operators, so the BRep is valid whenever `place` is called.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/geometry.hpp>
#include <brep/small_list.hpp>
#include <brep/t_vertices.hpp>  // eliminate_t_vertices
#include <brep/tag.hpp>

namespace brep {

using Corners = SmallList<HalfedgeId, 16>;

// The half-edges of f whose origins are its corners, counter-clockwise, corner 0 first: that is the first vertex of level <= l
// met when walking backward from the anchor (when a neighbour splits the edge, a T-vertex may get between the two).
// Empty when f has no corner at all.
template <class B>
[[nodiscard]] Corners corners(const B& brep, FaceId f) {
  const auto level = brep.data(f).level;
  const auto is_corner = [&](HalfedgeId h) { return brep.data(brep.vertex(h)).level <= level; };
  Corners result;
  HalfedgeId first = brep.halfedge(f);
  while (!is_corner(first)) {
    first = brep.prev(first);
    if (first == brep.halfedge(f)) { return result; }
  }
  HalfedgeId h = first;
  do {
    if (is_corner(h)) { result.push_back(h); }
    h = brep.next(h);
  } while (h != first);
  return result;
}

namespace detail {

// Half-edge between the corner c and the next one that starts at the vertex of level l + 1; invalid when there is none.
template <class B>
HalfedgeId mid_edge(const B& brep, HalfedgeId c, HalfedgeId next_corner, unsigned level) {
  for (HalfedgeId h = brep.next(c); h != next_corner; h = brep.next(h)) {
    if (brep.data(brep.vertex(h)).level == level + 1) { return h; }
  }
  return {};
}

template <class B, class Place>
void put(B& brep, VertexId v, const glm::dvec3& guess, unsigned level, Place& place) {
  brep.data(v).position = guess;
  brep.data(v).level = static_cast<std::uint8_t>(level);
  place(brep, v);
}

// Cuts the child that begins with the half-edge `from` (its origin is the last point before the child's first mid-edge point)
// off the face of `to`, and notes it. The result runs from.vertex -> to.vertex in what remains.
template <class B>
HalfedgeId cut_child(B& brep, HalfedgeId from, HalfedgeId to, std::vector<FaceId>& children) {
  const HalfedgeId h = unchecked::split_face(brep, from, to);
  children.push_back(brep.face(twin(h)));
  return h;
}

}  // namespace detail

// Refines f into its children, in the order of its corners (a triangle's middle child last). The FaceId and the data of f go on as
// child 0; the others start with a copy of the data; all get level l + 1 and their corner 0 as anchor.
// place(brep, v) is called once for each new vertex, after its position was set to the mid-point of the two corners or the
// centroid of the corners; it may move it, e.g. onto the true surface.
// Refused (nothing changes): f is dead or has fewer than three corners; its level is 255; an edge between two corners has
// vertices, but none of level l + 1 (the levels were not made by refine).
template <class B, class Place>
Result<std::vector<FaceId>> refine(B& brep, FaceId f, Place&& place) {
  if (!brep.alive(f)) { return Refusal{Code::dead, {f}}; }
  const unsigned level = brep.data(f).level;
  if (level == 255) { return Refusal{Code::level_limit, {f}}; }
  Corners corner = corners(brep, f);
  const std::size_t n = corner.size();
  if (n < 3) { return Refusal{Code::few_corners, {f}}; }
  if (detail::Raw::halfedges(brep).size() > 0x7ffffff0u - 8 * static_cast<std::uint32_t>(n)) { return Refusal{Code::full, {}}; }
  SmallList<glm::dvec3> outline;
  for (std::size_t k = 0; k < n; ++k) {
    const HalfedgeId next_corner = corner[(k + 1) % n];
    outline.push_back(brep.data(brep.vertex(corner[k])).position);
    if (brep.next(corner[k]) != next_corner && !detail::mid_edge(brep, corner[k], next_corner, level).valid()) {
      return Refusal{Code::irregular_levels, {brep.vertex(corner[k]), f}};
    }
  }

  Corners middle;  // the half-edges of f that start at the mid-edge points
  for (std::size_t k = 0; k < n; ++k) {
    HalfedgeId m = detail::mid_edge(brep, corner[k], corner[(k + 1) % n], level);
    if (!m.valid()) {
      const HalfedgeId other = twin(corner[k]);
      m = unchecked::split_edge(brep, corner[k]);
      if (brep.face(other) == f) {  // f lies on both sides of this edge: the other side's corner moved to the new half
        for (HalfedgeId& c : corner) {
          if (c == other) { c = brep.prev(other); }
        }
      }
      detail::put(brep, brep.vertex(m), 0.5 * (outline[k] + outline[(k + 1) % n]), level + 1, place);
    }
    middle.push_back(m);
  }

  std::vector<FaceId> children;
  children.reserve(n == 3 ? 4 : n);
  children.push_back(f);
  brep.data(f).level = static_cast<std::uint8_t>(level + 1);  // copied to the children
  HalfedgeId h = detail::cut_child(brep, middle[0], middle[1], children);
  if (n == 3) {
    detail::cut_child(brep, middle[1], middle[2], children);
    detail::cut_child(brep, h, middle[2], children);
    brep.set_anchor(children[3], h);
  } else {
    HalfedgeId spoke = unchecked::split_edge(brep, h);  // centre -> mid-edge point
    detail::put(brep, brep.vertex(spoke), centroid(Polygon{outline.data(), outline.size()}), level + 1, place);
    for (std::size_t k = 2; k < n; ++k) { spoke = detail::cut_child(brep, spoke, middle[k], children); }
  }
  for (std::size_t k = 0; k < n; ++k) { brep.set_anchor(children[k], corner[k]); }
  return children;
}

// The same with new vertices left at mid-points and centroids.
template <class B>
Result<std::vector<FaceId>> refine(B& brep, FaceId f) {
  return refine(brep, f, [](B&, VertexId) {});
}

}  // namespace brep
