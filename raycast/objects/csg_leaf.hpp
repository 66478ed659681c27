// SPDX-License-Identifier: MIT
#pragma once

// The approximation of one leaf of a CSG tree: coarse as a whole, and finer at the places where smaller parts of the tree meet it.
//
// Where it is too coarse the mesh is refined by bisecting triangles at their longest edges, both sides at once (Rivara 1984), so it stays
// closed without T-vertices and its angles do not decay. New vertices are put onto the true surface.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/small_list.hpp>

#include <raycast/box.hpp>
#include <raycast/transform.hpp>

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

// The faces, behind what is there already.
void append(const CsgBRep& brep, brep::Builder& out);

// How far the face is off its sheet, at the middles of its edges and at its own.
double chord_error(const PlacedObject& solid, const CsgBRep& brep, brep::FaceId f);

class CsgRefinement {
 public:
  // Goes on until no place is too coarse, or there are more than `most` faces.
  CsgRefinement(const PlacedObject& solid, const std::vector<CsgPlace>& places, CsgBRep& brep, std::size_t most);
  [[nodiscard]] bool changed() const { return changed_; }

 private:
  [[nodiscard]] bool is_coarse(brep::FaceId f) const;

  // Longer edges come first; of equal ones that of the higher number, so that a way to ever longer edges ends.
  [[nodiscard]] bool longer(brep::HalfedgeId a, brep::HalfedgeId b) const {
    const double x = length(a), y = length(b);
    return x != y ? x > y : brep::edge(a).index > brep::edge(b).index;
  }
  [[nodiscard]] double length(brep::HalfedgeId h) const {
    h = brep::halfedge(brep::edge(h));
    return glm::length(brep_.data(brep_.target(h)).position - brep_.data(brep_.vertex(h)).position);
  }
  [[nodiscard]] brep::HalfedgeId longest(brep::FaceId f) const;

  // One step towards a finer face f; faces that were cut are added to `look`. A plane cap only gets a vertex at its rim.
  void bisect(brep::FaceId f, std::vector<brep::FaceId>& look);
  // A quadrilateral along its shorter diagonal.
  void cut(brep::FaceId f, std::vector<brep::FaceId>& look);
  [[nodiscard]] std::size_t corners(brep::FaceId f) const { return brep::positions(brep_, f).size(); }

  [[nodiscard]] glm::dvec3 onto(std::uint32_t sheet, std::uint32_t other, glm::dvec3 p) const;

  const PlacedObject& solid_;
  const std::vector<CsgPlace>& places_;
  CsgBRep& brep_;
  bool changed_ = false;
};

}  // namespace detail

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_leaf.cpp>
#endif
