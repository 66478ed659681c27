// SPDX-License-Identifier: MIT
#pragma once

// The approximation of one leaf of a CSG tree: coarse as a whole, finer where smaller parts of the tree meet it.
//
// Where it is too coarse, the mesh is refined by bisection of triangles at their longest edges, on both sides at once (Rivara 1984), so
// it remains closed without T-vertices and its angles are bounded. New vertices are projected onto the true surface.

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

// A box in which faces must be within `tolerance` of the true surface.
struct CsgPlace {
  Box box;
  double tolerance;
};

namespace detail {

// Appends the faces to those in `out`.
void append(const CsgBRep& brep, brep::Builder& out);

// The distance of the face from its sheet, at the midpoints of its edges and at its centre.
double chord_error(const PlacedObject& solid, const CsgBRep& brep, brep::FaceId f);

class CsgRefinement {
 public:
  // Refines until no place is too coarse, or until there are more than `most` faces.
  CsgRefinement(const PlacedObject& solid, const std::vector<CsgPlace>& places, CsgBRep& brep, std::size_t most);
  [[nodiscard]] bool changed() const { return changed_; }

 private:
  [[nodiscard]] bool is_coarse(brep::FaceId f) const;

  // Is edge a longer than b? Of equal edges the one with the higher number counts as longer, so a path to ever longer edges ends.
  [[nodiscard]] bool longer(brep::HalfedgeId a, brep::HalfedgeId b) const {
    const double x = length(a), y = length(b);
    return x != y ? x > y : brep::edge(a).index > brep::edge(b).index;
  }
  [[nodiscard]] double length(brep::HalfedgeId h) const {
    h = brep::halfedge(brep::edge(h));
    return glm::length(brep_.data(brep_.target(h)).position - brep_.data(brep_.vertex(h)).position);
  }
  [[nodiscard]] brep::HalfedgeId longest(brep::FaceId f) const;

  // One bisection towards a finer face f; faces that were divided are added to `look`. A plane cap only gets a new vertex on its rim.
  void bisect(brep::FaceId f, std::vector<brep::FaceId>& look);
  // Divides a quadrilateral along its shorter diagonal.
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
