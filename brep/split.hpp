// SPDX-License-Identifier: MIT
#pragma once

// Recursive face splits: split objects combined with condition objects (paper 2.2).
//
// A split object (split_objects.hpp) is the geometric decision where a face is cut, a condition object (conditions.hpp) decides whether
// a face is finished; user lambdas will do for both. split_recursively cuts until each part is finished or has no place for a cut.
//
// The recursion ends, whatever the two objects answer. Let p be the sum of (edges - 3) over the parts of more than three edges. A
// cut between corners that are neither equal nor adjacent makes p smaller by exactly one, since the two parts of a face of n edges
// have n + 2 edges together; any other cut is refused. A new vertex adds at most one to p for each side of its edge. Hence at most
// p(start) + 2 vertex_limit cuts are made. A condition that diagonals cannot reach (AreaBelow) ends when no diagonal is left: the parts
// that miss it are reported as unfinished. AlongPlane inserts at most as many vertices as the face has edges. A split object that
// would insert vertices beyond the limit is refused.
//
// Every cut is one split_face, with the ends in the order in which the shorter side is relabelled: the largest part keeps its FaceId as
// a rule. The data of the parts follow the rule of split_face; a new vertex has default data, and its `position`, if there is one, on the
// edge.

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <brep/circulators.hpp>
#include <brep/conditions.hpp>
#include <brep/euler.hpp>
#include <brep/geometry.hpp>
#include <brep/outline.hpp>
#include <brep/split_objects.hpp>
#include <brep/split_plane.hpp>

namespace brep {

// What split_recursively made.
struct Parts {
  struct Step {
    HalfedgeId h;     // the result of split_face or split_edge
    bool new_vertex;  // split_edge: h starts at the new vertex
  };
  std::vector<FaceId> faces;       // all parts; the faces that were given come first
  std::vector<FaceId> unfinished;  // those for which the condition does not hold, and no place for a cut was found
  std::vector<Step> steps;         // in the order in which they were made
};

// Takes all steps back, last first, and so restores every record. The parts must be as split_recursively left them.
template <class B>
void rejoin(B& brep, const Parts& parts) {
  for (std::size_t i = parts.steps.size(); i-- > 0;) {
    if (parts.steps[i].new_vertex) {
      unchecked::join_vertices(brep, twin(parts.steps[i].h));
    } else {
      unchecked::join_faces(brep, parts.steps[i].h);
    }
  }
}

namespace detail {

// The same for a refusal: a log is as before, too. Nothing was changed since the steps, each of which is one step of the log.
template <class B>
void take_back(B& brep, const Parts& parts) {
  if constexpr (B::logs) {
    undo_to(brep, mark(brep) - parts.steps.size());
  } else {
    rejoin(brep, parts);
  }
}

template <class B>
class FaceSplit {
 public:
  FaceSplit(B& brep, std::span<const FaceId> given, std::size_t vertex_limit) : brep_(brep), vertices_left_(vertex_limit) {
    parts_.faces.assign(given.begin(), given.end());
  }

  template <class Split, class Condition>
  Result<Parts> run(Split& split, Condition& finished) {
    for (bool again = true; again;) {  // a vertex inserted for one part can lie on a part that was finished
      again = false;
      parts_.unfinished.clear();
      for (std::size_t i = 0; i < parts_.faces.size();) {
        const FaceId part = parts_.faces[i];
        if (finished(std::as_const(brep_), part)) {
          ++i;
          continue;
        }
        const Cut cut = split(std::as_const(brep_), part);
        if (!cut.a.valid()) {
          parts_.unfinished.push_back(part);
          ++i;
          continue;
        }
        if (const Refusal refusal = apply(part, cut); refusal.code != Code::none) {
          take_back(brep_, parts_);
          return refusal;
        }
        again = again || cut.on_a > 0.0 || cut.on_b > 0.0;
      }
    }
    return std::move(parts_);
  }

 private:
  Refusal apply(FaceId part, Cut cut) {
    for (const auto& [h, on] : {std::pair{cut.a, cut.on_a}, std::pair{cut.b, cut.on_b}}) {
      if (!brep_.alive(h)) { return {Code::dead, {h}}; }
      if (brep_.face(h) != part) { return {Code::not_on_face, {h, part}}; }
      if (!(on >= 0.0 && on < 1.0)) { return {Code::not_on_edge, {h}}; }
    }
    if (edge(cut.a) == edge(cut.b) && cut.on_a > 0.0 && cut.on_b > 0.0) { return {Code::no_progress, {cut.a, cut.b}}; }
    const HalfedgeId a = cut.a, b = cut.b;
    if (cut.on_a > 0.0) {
      if (const Refusal refusal = insert(part, a, cut.on_a, cut.a, cut.b); refusal.code != Code::none) { return refusal; }
    }
    if (cut.on_b > 0.0) {
      if (const Refusal refusal = insert(part, b, cut.on_b, cut.b, cut.a); refusal.code != Code::none) { return refusal; }
    }
    if (cut.a == cut.b || brep_.next(cut.a) == cut.b || brep_.next(cut.b) == cut.a) { return {Code::no_progress, {a, b}}; }
    if (Raw::halfedges(brep_).full()) { return {Code::full, {}}; }
    const bool in_order = first_side_is_shorter(brep_, cut.a, cut.b);
    const HalfedgeId h = unchecked::split_face(brep_, in_order ? cut.a : cut.b, in_order ? cut.b : cut.a);
    parts_.steps.push_back({h, false});
    parts_.faces.push_back(brep_.face(twin(h)));
    return {};
  }

  // Puts a vertex on h; `end` becomes the half-edge that starts there, and the other end is renamed where it started on twin(h).
  Refusal insert(FaceId part, HalfedgeId h, double fraction, HalfedgeId& end, HalfedgeId& other) {
    if (vertices_left_ == 0) { return {Code::vertex_limit, {part}}; }
    if (Raw::halfedges(brep_).full()) { return {Code::full, {}}; }
    --vertices_left_;
    const VertexId from = brep_.vertex(h), to = brep_.target(h);
    end = unchecked::split_edge(brep_, h);
    if (other == twin(h)) { other = twin(end); }
    auto& data = brep_.data(brep_.vertex(end));
    if constexpr (requires { data.position; }) {
      data.position = (1.0 - fraction) * brep_.data(from).position + fraction * brep_.data(to).position;
    }
    parts_.steps.push_back({end, true});
    return {};
  }

  B& brep_;
  std::size_t vertices_left_;
  Parts parts_;
};

}  // namespace detail

template <class S, class B>
concept SplitObjectFor = std::is_invocable_r_v<Cut, S&, const B&, FaceId>;
template <class C, class B>
concept ConditionFor = std::is_invocable_r_v<bool, C&, const B&, FaceId>;

// Cuts the faces until finished(brep, part) holds for every part, or split(brep, part) finds no place in it.
// Refused (nothing changes): a face is dead; the answer of the split object is not on its part (dead, not_on_face, not_on_edge),
// joins equal or adjacent corners (no_progress), or asks for more than `vertex_limit` new vertices in all; no handle is left.
// With a log the cuts that were taken back could be redone.
// Inverse: rejoin. Time: one call of both objects for each cut and part.
template <class B, SplitObjectFor<B> Split, ConditionFor<B> Condition>
[[nodiscard]] Result<Parts> split_recursively(B& brep, std::span<const FaceId> faces, Split&& split, Condition&& finished,
                                              std::size_t vertex_limit = 65536) {
  for (FaceId f : faces) {
    if (!brep.alive(f)) { return Refusal{Code::dead, {f}}; }
  }
  return detail::FaceSplit<B>(brep, faces, vertex_limit).run(split, finished);
}
// The same for one face.
template <class B, SplitObjectFor<B> Split, ConditionFor<B> Condition>
[[nodiscard]] Result<Parts> split_recursively(B& brep, FaceId f, Split&& split, Condition&& finished, std::size_t vertex_limit = 65536) {
  return split_recursively(brep, std::span<const FaceId>(&f, 1), split, finished, vertex_limit);
}
// The same for all faces.
template <class B, SplitObjectFor<B> Split, ConditionFor<B> Condition>
[[nodiscard]] Result<Parts> split_recursively(B& brep, Split&& split, Condition&& finished, std::size_t vertex_limit = 65536) {
  std::vector<FaceId> all;
  for (FaceId f : faces(brep)) { all.push_back(f); }
  return split_recursively(brep, std::span<const FaceId>(all), split, finished, vertex_limit);
}

namespace detail {

template <class B>
[[nodiscard]] Refusal check_corners(const B& brep, FaceId f) {
  if (!brep.alive(f)) { return {Code::dead, {f}}; }
  return degree(brep, f) < 3 ? Refusal{Code::few_corners, {f}} : Refusal{};
}

// Is f a polygon that diagonals can take apart: finite, with area, and with a boundary that meets itself at bridges alone?
template <class B>
[[nodiscard]] Refusal check_polygon(const B& brep, FaceId f, double greatest_planarity) {
  if (const Refusal refusal = check_corners(brep, f); refusal.code != Code::none) { return refusal; }
  const auto points = positions(brep, f);
  const double size = extent(points);
  if (!std::isfinite(size) || !(area(points) > 1e-14 * size * size)) { return {Code::degenerate_polygon, {f}}; }
  if (planarity(points) > greatest_planarity) { return {Code::not_planar, {f}}; }
  if (is_convex(points)) { return {}; }
  if (const auto contact = Outline(points).self_contact()) { return {Code::not_simple, {f, brep.vertex(loop_of(brep, f)[*contact])}}; }
  return {};
}

}  // namespace detail

// Cuts a planar simple face, with holes if they are reached by bridge edges, by inner diagonals until all parts are convex, and returns
// the parts, f first. No vertex is added, so the parts cover the face exactly.
// Refused (nothing changes): f is dead, has fewer than three corners or no area; it is not planar (planarity above 1e-6); its
// boundary crosses or touches itself.
template <class B>
[[nodiscard]] Result<std::vector<FaceId>> split_until_convex(B& brep, FaceId f) {
  if (const Refusal refusal = detail::check_polygon(brep, f, 1e-6); refusal.code != Code::none) { return refusal; }
  Result<Parts> parts = split_recursively(brep, f, AtNonConvexCorner{}, Convex{});
  if (!parts) { return parts.refusal(); }
  if (parts->unfinished.empty()) { return std::move(parts->faces); }
  detail::take_back(brep, *parts);  // a simple polygon always has such diagonals; only one that is degenerate within rounding ends here
  return Refusal{Code::degenerate_polygon, {f}};
}

// The same for a face that need be neither simple nor planar, as long as it would be if its corners moved by a little: one that
// comes within rounding of itself, a thin one, a warped one. Where no inner diagonal is left, the triangulation that overlaps least is
// followed (least_overlap.hpp). The parts are convex or triangles; among the triangles some may have no area, within rounding.
// Refused (nothing changes): f is dead or has fewer than three corners; no handle is left; more than most_corners_of_least_overlap
// corners are left when no inner diagonal is, with the refusal of split_until_convex.
template <class B>
[[nodiscard]] Result<std::vector<FaceId>> split_nearly_simple(B& brep, FaceId f) {
  Result<std::vector<FaceId>> simple = split_until_convex(brep, f);
  if (simple) { return simple; }
  if (const Refusal refusal = detail::check_corners(brep, f); refusal.code != Code::none) { return refusal; }
  const auto split = first_of(AtNonConvexCorner{}, AtLeastOverlap{normal(brep, f)});
  Result<Parts> parts = split_recursively(brep, f, split, Convex{} || triangles);
  if (!parts) { return parts.refusal(); }
  if (parts->unfinished.empty()) { return std::move(parts->faces); }
  detail::take_back(brep, *parts);
  return simple.refusal();
}

}  // namespace brep
