// SPDX-License-Identifier: MIT
#pragma once

// Recursive face splits: split objects combined with condition objects (paper 2.2).
//
// A split object is the geometric decision where a face is cut; it answers with two half-edges of the face, or with
// invalid ones when it finds no place. A condition object decides whether a face is finished. split_recursively cuts until all
// parts are finished. Any function object of the right shape will do; those of the paper are here and in t_vertices.hpp.
//
// Every cut is one split_face, asked for such that the shorter side is relabelled: the largest part keeps its FaceId as a rule.

#include <cmath>
#include <cstddef>
#include <vector>

#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/geometry.hpp>
#include <brep/outline.hpp>

namespace brep {

struct Cut {
  HalfedgeId a{}, b{};
};

namespace detail {

template <class B>
[[nodiscard]] SmallList<HalfedgeId> loop_of(const B& brep, FaceId f) {
  SmallList<HalfedgeId> loop;
  for (HalfedgeId h : halfedges_of(brep, f)) loop.push_back(h);
  return loop;
}

}  // namespace detail

// Condition object: the face is convex (polygon.hpp says with which tolerance).
struct Convex {
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return is_convex(brep, f);
  }
};

// Condition object: the face has at most `edges` edges.
struct AtMost {
  std::size_t edges = 4;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return degree(brep, f) <= edges;
  }
};

// Split object: the best proportioned inner diagonal from the corner that turns right the most.
struct AtNonConvexCorner {
  template <class B>
  Cut operator()(const B& brep, FaceId f) const {
    const Outline outline{Polygon(positions(brep, f))};
    std::size_t corner = 0;
    for (std::size_t i = 1; i < outline.size(); ++i) {
      if (outline.turn(i) < outline.turn(corner)) corner = i;
    }
    const auto diagonal = outline.best_diagonal(corner);
    if (!diagonal) return {};
    const auto loop = detail::loop_of(brep, f);
    return {loop[diagonal->first], loop[diagonal->second]};
  }
};

// Split object: the best proportioned of all inner diagonals.
struct NiceSplit {
  template <class B>
  Cut operator()(const B& brep, FaceId f) const {
    const auto diagonal = Outline{Polygon(positions(brep, f))}.best_diagonal();
    if (!diagonal) return {};
    const auto loop = detail::loop_of(brep, f);
    return {loop[diagonal->first], loop[diagonal->second]};
  }
};

// Cuts f until finished(brep, part) holds for every part or split(brep, part) finds no place. Returns the parts, f first;
// the new edges are added to `cuts` in the order in which they were made.
template <class B, class Split, class Condition>
std::vector<FaceId> split_recursively(B& brep, FaceId f, Split&& split, Condition&& finished, std::vector<HalfedgeId>& cuts) {
  std::vector<FaceId> parts{f};
  for (std::size_t i = 0; i < parts.size();) {
    if (finished(brep, parts[i])) {
      ++i;
      continue;
    }
    const Cut cut = split(brep, parts[i]);
    if (!cut.a.valid()) {
      ++i;
      continue;
    }
    const bool in_order = first_side_is_shorter(brep, cut.a, cut.b);
    const HalfedgeId h = unchecked::split_face(brep, in_order ? cut.a : cut.b, in_order ? cut.b : cut.a);
    cuts.push_back(h);
    parts.push_back(brep.face(twin(h)));
  }
  return parts;
}

// Cuts a planar simple face by inner diagonals until all parts are convex, and returns the parts, f first. New faces have
// f's data; no vertex is added, so the parts cover the face exactly.
// Refused (nothing changes): f is dead, has fewer than three corners or no area; it is not planar (planarity above 1e-6); its
// boundary crosses or touches itself.
template <class B>
[[nodiscard]] Result<std::vector<FaceId>> split_until_convex(B& brep, FaceId f) {
  if (!brep.alive(f)) return Refusal{Code::dead, {f}};
  const auto points = positions(brep, f);
  if (points.size() < 3) return Refusal{Code::few_corners, {f}};
  const double size = extent(points);
  if (!std::isfinite(size) || !(area(points) > 1e-14 * size * size)) return Refusal{Code::degenerate_polygon, {f}};
  if (planarity(points) > 1e-6) return Refusal{Code::not_planar, {f}};
  if (is_convex(points)) return std::vector<FaceId>{f};
  if (const auto contact = Outline(points).self_contact()) {
    return Refusal{Code::not_simple, {f, brep.vertex(detail::loop_of(brep, f)[*contact])}};
  }
  std::vector<HalfedgeId> cuts;
  std::vector<FaceId> parts = split_recursively(brep, f, AtNonConvexCorner{}, Convex{}, cuts);
  for (FaceId part : parts) {
    if (is_convex(brep, part)) continue;
    // A simple polygon always has such diagonals; only one that is degenerate within rounding ends here. Undo.
    for (std::size_t i = cuts.size(); i-- > 0;) unchecked::join_faces(brep, cuts[i]);
    return Refusal{Code::degenerate_polygon, {f}};
  }
  return parts;
}

}  // namespace brep
