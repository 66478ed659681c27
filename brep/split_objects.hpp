// SPDX-License-Identifier: MIT
#pragma once

// Split objects: where is this face cut? (paper 2.2: "split objects encapsulate the geometric decision where faces should be split")
//
// A split object is any function object Cut(const BRep&, FaceId). It changes nothing, it answers: the two ends of the cut, or
// a default Cut when it finds no place. An end is a corner of the face, or a point inside an edge, where split_recursively
// then inserts a vertex. Further ones: AtTVertex (t_vertices.hpp), AlongPlane (split_plane.hpp), lambdas.
//
//   first_of(AtTVertex{}, NiceSplit{})    asks one after the other until one finds a place

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/least_overlap.hpp>
#include <brep/outline.hpp>
#include <brep/small_list.hpp>

namespace brep {

// The cut runs from vertex(a) to vertex(b); with on_a > 0 from the point at that fraction of a, 0 < on_a < 1; so for b.
struct Cut {
  HalfedgeId a{}, b{};
  double on_a = 0.0, on_b = 0.0;
};

namespace detail {

template <class B>
[[nodiscard]] SmallList<HalfedgeId> loop_of(const B& brep, FaceId f) {
  SmallList<HalfedgeId> loop;
  for (HalfedgeId h : halfedges_of(brep, f)) { loop.push_back(h); }
  return loop;
}

template <class... Splits>
struct FirstOf {
  std::tuple<Splits...> splits;
  template <class B>
  Cut operator()(const B& brep, FaceId f) const {
    Cut cut;
    std::apply([&](const auto&... each) { (void)((cut = each(brep, f), cut.a.valid()) || ...); }, splits);
    return cut;
  }
};

}  // namespace detail

// The answer of the first of the split objects that finds a place.
template <class... Splits>
[[nodiscard]] auto first_of(Splits&&... splits) {
  return detail::FirstOf<std::decay_t<Splits>...>{{std::forward<Splits>(splits)...}};
}

// The best proportioned inner diagonal from the corner that turns right the most; no place in a face without such corners.
struct AtNonConvexCorner {
  template <class B>
  Cut operator()(const B& brep, FaceId f) const {
    const Outline outline{Polygon(positions(brep, f))};
    std::size_t corner = 0;
    for (std::size_t i = 1; i < outline.size(); ++i) {
      if (outline.turn(i) < outline.turn(corner)) { corner = i; }
    }
    if (!(outline.turn(corner) < 0.0)) { return {}; }
    const auto diagonal = outline.best_diagonal(corner);
    if (!diagonal) { return {}; }
    const auto loop = detail::loop_of(brep, f);
    return {loop[diagonal->first], loop[diagonal->second]};
  }
};

// The best proportioned of all inner diagonals. Every planar simple face of four and more corners has one.
struct NiceSplit {
  template <class B>
  Cut operator()(const B& brep, FaceId f) const {
    const auto diagonal = Outline{Polygon(positions(brep, f))}.best_diagonal();
    if (!diagonal) { return {}; }
    const auto loop = detail::loop_of(brep, f);
    return {loop[diagonal->first], loop[diagonal->second]};
  }
};

// For faces that no inner diagonal cuts, because they come within rounding of themselves or are warped: of the triangulation that overlaps
// least (least_overlap.hpp), the diagonal that comes nearest to halving the corners. Finds a place in every face of 4 to
// most_corners_of_least_overlap edges.
// The parts are seen along the normal of the whole face, because those without area have none of their own.
struct AtLeastOverlap {
  glm::dvec3 normal{0.0};
  template <class B>
  Cut operator()(const B& brep, FaceId f) const {
    const auto loop = detail::loop_of(brep, f);
    const std::size_t n = loop.size();
    if (n < 4 || n > most_corners_of_least_overlap) { return {}; }
    std::size_t most = 1;  // corners on the smaller side of the diagonal
    Cut best;
    for (const auto& [i, k, j] : least_overlap(Outline{Polygon(positions(brep, f)), normal})) {
      const std::size_t smaller = std::min<std::size_t>(j - i, n - (j - i));
      if (smaller <= most) { continue; }
      most = smaller;
      best = {loop[i], loop[j]};
    }
    return best;
  }
};

}  // namespace brep
