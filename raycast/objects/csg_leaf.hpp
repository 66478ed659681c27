// SPDX-License-Identifier: MIT
#pragma once

// The approximation of one leaf of a CSG tree: coarse as a whole, and finer at the places where smaller parts of the tree meet it.
//
// Where it is too coarse the mesh is refined by bisecting triangles at their longest edges, both sides at once (Rivara 1984), so it stays
// closed without T-vertices and its angles do not decay. New vertices are put onto the true surface.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <brep/builder.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/unchecked.hpp>

#include "csg_tree.hpp"

namespace raycast {

struct CsgVertex {
  glm::dvec3 position{0.0};
};
struct CsgFace {
  std::uint32_t sheet = brep::no_sheet;
};
using CsgBRep = brep::BRep<CsgVertex, brep::NoData, CsgFace>;

// A box in which faces may be off the true surface by no more than `tolerance`.
struct CsgPlace {
  Box box;
  double tolerance;
};

namespace detail {

// How far the face is off its sheet, at the middles of its edges and at its own.
inline double chord_error(const PlacedObject& solid, const CsgBRep& brep, brep::FaceId f) {
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

class CsgRefinement {
 public:
  // Goes on until no place is too coarse, or there are more than `most` faces.
  CsgRefinement(const PlacedObject& solid, const std::vector<CsgPlace>& places, CsgBRep& brep, std::size_t most)
      : solid_(solid), places_(places), brep_(brep) {
    std::vector<brep::FaceId> look;
    for (const brep::FaceId f : brep::faces(brep)) look.push_back(f);
    while (!look.empty()) {
      const brep::FaceId f = look.back();
      look.pop_back();
      while (is_coarse(f)) {
        if (brep.face_count() > most) return;
        bisect(f, look);
        changed_ = true;
      }
    }
  }
  [[nodiscard]] bool changed() const { return changed_; }

 private:
  [[nodiscard]] bool is_coarse(brep::FaceId f) const {
    const double error = chord_error(solid_, brep_, f);
    Box box;
    for (const brep::HalfedgeId h : brep::halfedges_of(brep_, f)) box.extend(brep_.data(brep_.vertex(h)).position);
    box = box.grown(2 * error);
    return std::any_of(places_.begin(), places_.end(), [&](const CsgPlace& place) {
      if (error <= place.tolerance) return false;
      const glm::dvec3 lo = glm::max(box.lo, place.box.lo), hi = glm::min(box.hi, place.box.hi);
      return lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z;
    });
  }

  // Longer edges come first; of equal ones that of the higher number, so that a way to ever longer edges ends.
  [[nodiscard]] bool longer(brep::HalfedgeId a, brep::HalfedgeId b) const {
    const double x = length(a), y = length(b);
    return x != y ? x > y : brep::edge(a).index > brep::edge(b).index;
  }
  [[nodiscard]] double length(brep::HalfedgeId h) const {
    h = brep::halfedge(brep::edge(h));
    return glm::length(brep_.data(brep_.target(h)).position - brep_.data(brep_.vertex(h)).position);
  }
  [[nodiscard]] brep::HalfedgeId longest(brep::FaceId f) const {
    brep::HalfedgeId best = brep_.halfedge(f);
    for (const brep::HalfedgeId h : brep::halfedges_of(brep_, f))
      if (longer(h, best)) best = h;
    return best;
  }

  // One step towards a finer face f; faces that were cut are added to `look`. A plane cap only gets a vertex at its rim.
  void bisect(brep::FaceId f, std::vector<brep::FaceId>& look) {
    for (;;) {
      if (corners(f) == 4) return cut(f, look);
      const brep::HalfedgeId h = longest(f);
      const brep::FaceId g = brep_.face(brep::twin(h));
      if (corners(g) == 4) return cut(g, look);
      if (corners(g) == 3 && brep::edge(longest(g)) != brep::edge(h)) {
        f = g;
        continue;
      }
      const glm::dvec3 middle = 0.5 * (brep_.data(brep_.vertex(h)).position + brep_.data(brep_.target(h)).position);
      const brep::HalfedgeId rest = brep::unchecked::split_edge(brep_, h);  // from the new vertex on, along f
      brep_.data(brep_.vertex(rest)).position = onto(brep_.data(f).sheet, brep_.data(g).sheet, middle);
      for (const brep::HalfedgeId at : {rest, brep::twin(brep_.prev(rest))}) {
        look.push_back(brep_.face(at));
        if (corners(brep_.face(at)) != 4) continue;
        const brep::HalfedgeId cut = brep::unchecked::split_face(brep_, at, brep_.next(brep_.next(at)));
        look.push_back(brep_.face(cut));
        look.push_back(brep_.face(brep::twin(cut)));
      }
      return;
    }
  }
  // A quadrilateral along its shorter diagonal.
  void cut(brep::FaceId f, std::vector<brep::FaceId>& look) {
    brep::HalfedgeId h = brep_.halfedge(f);
    const auto diagonal = [&](brep::HalfedgeId a) {
      return glm::length(brep_.data(brep_.vertex(a)).position - brep_.data(brep_.vertex(brep_.next(brep_.next(a)))).position);
    };
    if (diagonal(brep_.next(h)) < diagonal(h)) h = brep_.next(h);
    const brep::HalfedgeId made = brep::unchecked::split_face(brep_, h, brep_.next(brep_.next(h)));
    look.push_back(brep_.face(made));
    look.push_back(brep_.face(brep::twin(made)));
  }
  [[nodiscard]] std::size_t corners(brep::FaceId f) const { return brep::positions(brep_, f).size(); }

  [[nodiscard]] glm::dvec3 onto(std::uint32_t sheet, std::uint32_t other, glm::dvec3 p) const {
    for (int round = 0; round < (sheet == other ? 1 : 8); ++round) {
      p = solid_.project(sheet, p).position;
      if (sheet != other) p = solid_.project(other, p).position;
    }
    return p;
  }

  const PlacedObject& solid_;
  const std::vector<CsgPlace>& places_;
  CsgBRep& brep_;
  bool changed_ = false;
};

}  // namespace detail

}  // namespace raycast
