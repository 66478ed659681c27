// SPDX-License-Identifier: MIT
#pragma once

// What is lost when an exact solid is written with coordinates in double: edges that shrink to a point, faces that lose their area or turn
// over. The exact solid is sound even so; another program may fail on the rounded one.
//
// Coordinates keep 2^-27 of the spacing of the grid, some 2^-53 of the model. Faces that come to touch or cross each other by rounding,
// without collapsing themselves, are not looked for.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/csg/solid.hpp>
#include <brep/csg/to_brep.hpp>

namespace brep::csg {

struct Collapse {
  std::vector<Element> elements;  // of the BRep of to_brep
  std::string sentence;
};

// All collapses of to_brep(solid), by rising face; empty: none.     Time: O(v).
template <class F>
[[nodiscard]] std::vector<Collapse> check_export(const Solid<F>& solid) {
  struct Placed {
    glm::dvec3 position{0.0};
  };
  using Plain = BRep<Placed>;
  const Plain brep = to_brep<Plain>(solid, [](NoData&, const F&) {});
  std::vector<Collapse> result;
  for (std::uint32_t f = 0; f < solid.face_count(); ++f) {
    const OrientedPlane oriented = solid.faces().faces[f].plane;
    const Plane& plane = solid.grid().planes()[oriented.number()];
    const glm::dvec3 normal = glm::dvec3{plane.normal[0], plane.normal[1], plane.normal[2]} * static_cast<double>(oriented.sign());
    const glm::dvec3 o = brep.data(brep.vertex(brep.halfedge(FaceId{f}))).position;
    glm::dvec3 sum{0.0};
    for (HalfedgeId h : halfedges_of(brep, FaceId{f})) {
      const glm::dvec3 a = brep.data(brep.vertex(h)).position, b = brep.data(brep.target(h)).position;
      sum += glm::cross(a - o, b - o);
      if (a == b && h < twin(h)) {
        result.push_back({{FaceId{f}, brep.vertex(h), brep.target(h)},
                          to_string(brep.vertex(h)) + " and " + to_string(brep.target(h)) + " of " + to_string(FaceId{f}) +
                              " have the same place when they are rounded to double"});
      }
    }
    if (!(glm::dot(sum, normal) > 0.0)) {
      result.push_back({{FaceId{f}}, to_string(FaceId{f}) + " has no area, or is turned over, when its vertices are rounded to double"});
    }
  }
  return result;
}

}  // namespace brep::csg
