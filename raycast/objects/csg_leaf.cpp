// SPDX-License-Identifier: MIT
#include <raycast/objects/csg_leaf.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/small_list.hpp>
#include <brep/unchecked.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

namespace raycast {

namespace detail {

HALFLIGHT_INLINE void append(const CsgBRep& brep, brep::Builder& out) {
  std::vector<std::uint32_t> number(brep.vertex_end(), 0), corners;
  for (const brep::VertexId v : brep::vertices(brep)) { number[v.index] = out.vertex(brep.data(v).position); }
  for (const brep::FaceId f : brep::faces(brep)) {
    corners.clear();
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) { corners.push_back(number[brep.vertex(h).index]); }
    out.face(corners, brep.data(f).sheet);
  }
}

HALFLIGHT_INLINE double chord_error(const PlacedObject& solid, const CsgBRep& brep, brep::FaceId f) {
  const auto corners = brep::positions(brep, f);
  const std::uint32_t sheet = brep.data(f).sheet;
  glm::dvec3 middle(0.0);
  double error = 0.0;
  const auto look = [&](const glm::dvec3& p) { error = std::max(error, glm::length(solid.project(sheet, p).position - p)); };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    look(0.5 * (corners[i] + corners[i + 1 < corners.size() ? i + 1 : 0]));
    middle += corners[i] / static_cast<double>(corners.size());
  }
  look(middle);
  return error;
}

HALFLIGHT_INLINE CsgRefinement::CsgRefinement(const PlacedObject& solid, const std::vector<CsgPlace>& places, CsgBRep& brep,
                                              std::size_t most)
    : solid_(solid), places_(places), brep_(brep) {
  std::vector<brep::FaceId> look;
  for (const brep::FaceId f : brep::faces(brep)) { look.push_back(f); }
  while (!look.empty()) {
    const brep::FaceId f = look.back();
    look.pop_back();
    while (is_coarse(f)) {
      if (brep.face_count() > most) { return; }
      bisect(f, look);
      changed_ = true;
    }
  }
}

HALFLIGHT_INLINE bool CsgRefinement::is_coarse(brep::FaceId f) const {
  const double error = chord_error(solid_, brep_, f);
  Box box;
  for (const brep::HalfedgeId h : brep::halfedges_of(brep_, f)) { box.extend(brep_.data(brep_.vertex(h)).position); }
  box = box.grown(2 * error);
  return std::any_of(places_.begin(), places_.end(), [&](const CsgPlace& place) {
    if (error <= place.tolerance) { return false; }
    const glm::dvec3 lo = glm::max(box.lo, place.box.lo), hi = glm::min(box.hi, place.box.hi);
    return lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z;
  });
}

HALFLIGHT_INLINE brep::HalfedgeId CsgRefinement::longest(brep::FaceId f) const {
  brep::HalfedgeId best = brep_.halfedge(f);
  for (const brep::HalfedgeId h : brep::halfedges_of(brep_, f)) {
    if (longer(h, best)) { best = h; }
  }
  return best;
}

HALFLIGHT_INLINE void CsgRefinement::bisect(brep::FaceId f, std::vector<brep::FaceId>& look) {
  for (;;) {
    if (corners(f) == 4) { return cut(f, look); }
    const brep::HalfedgeId h = longest(f);
    const brep::FaceId g = brep_.face(brep::twin(h));
    if (corners(g) == 4) { return cut(g, look); }
    if (corners(g) == 3 && brep::edge(longest(g)) != brep::edge(h)) {
      f = g;
      continue;
    }
    const glm::dvec3 middle = 0.5 * (brep_.data(brep_.vertex(h)).position + brep_.data(brep_.target(h)).position);
    const brep::HalfedgeId rest = brep::unchecked::split_edge(brep_, h);  // the half-edge of f that starts at the new vertex
    brep_.data(brep_.vertex(rest)).position = onto(brep_.data(f).sheet, brep_.data(g).sheet, middle);
    for (const brep::HalfedgeId at : {rest, brep::twin(brep_.prev(rest))}) {
      look.push_back(brep_.face(at));
      if (corners(brep_.face(at)) != 4) { continue; }
      const brep::HalfedgeId cut = brep::unchecked::split_face(brep_, at, brep_.next(brep_.next(at)));
      look.push_back(brep_.face(cut));
      look.push_back(brep_.face(brep::twin(cut)));
    }
    return;
  }
}

HALFLIGHT_INLINE void CsgRefinement::cut(brep::FaceId f, std::vector<brep::FaceId>& look) {
  brep::HalfedgeId h = brep_.halfedge(f);
  const auto diagonal = [&](brep::HalfedgeId a) {
    return glm::length(brep_.data(brep_.vertex(a)).position - brep_.data(brep_.vertex(brep_.next(brep_.next(a)))).position);
  };
  if (diagonal(brep_.next(h)) < diagonal(h)) { h = brep_.next(h); }
  const brep::HalfedgeId made = brep::unchecked::split_face(brep_, h, brep_.next(brep_.next(h)));
  look.push_back(brep_.face(made));
  look.push_back(brep_.face(brep::twin(made)));
}

HALFLIGHT_INLINE glm::dvec3 CsgRefinement::onto(std::uint32_t sheet, std::uint32_t other, glm::dvec3 p) const {
  for (int round = 0; round < (sheet == other ? 1 : 8); ++round) {
    p = solid_.project(sheet, p).position;
    if (sheet != other) { p = solid_.project(other, p).position; }
  }
  return p;
}

}  // namespace detail

}  // namespace raycast
