// SPDX-License-Identifier: MIT
#pragma once

// Makes the faces of a CSG tree's boundary convex, and takes away those that are thinner than the coordinates are exact.

#include <algorithm>
#include <string>
#include <vector>

#include <brep/geometry.hpp>
#include <brep/split.hpp>
#include <brep/unchecked.hpp>

#include "csg_leaf.hpp"

namespace raycast::detail {

// A face without area has no normal and no inside. It goes into the neighbour at its longest edge; nothing moves by more than it is thin.
inline void take_away_slivers(CsgBRep& brep) {
  std::vector<brep::FaceId> thin;
  for (const brep::FaceId f : brep::faces(brep)) {
    const auto corners = brep::positions(brep, f);
    const double size = brep::extent(corners);
    if (!(brep::area(corners) > 1e-9 * size * size) && !brep::is_convex(corners)) thin.push_back(f);
  }
  for (const brep::FaceId f : thin) {
    if (!brep.alive(f)) continue;
    brep::HalfedgeId longest{};
    double length = -1.0;
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      const double l = glm::length(brep.data(brep.target(h)).position - brep.data(brep.vertex(h)).position);
      if (brep.face(brep::twin(h)) == f || l <= length) continue;
      longest = brep::twin(h);
      length = l;
    }
    if (length < 0.0) continue;
    const brep::FaceId g = brep::unchecked::join_faces(brep, longest);
    for (bool again = true; again;) {  // of further common edges a spur is left
      again = false;
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, g)) {
        if (brep.next(h) != brep::twin(h) || brep.next(brep::twin(h)) == h) continue;
        brep::unchecked::join_vertices(brep, h);  // the end goes into the origin
        again = true;
        break;
      }
    }
  }
}

// Cuts all faces by diagonals until they are convex. Faces of curved sheets need not be planar: where no diagonal is found they fall into
// triangles. Returns a face of a flat sheet that is not simple, if there is one.
template <class FlatSheet>
[[nodiscard]] brep::Refusal cut_into_convex_parts(CsgBRep& brep, FlatSheet&& is_flat) {
  std::vector<brep::FaceId> concave;
  for (const brep::FaceId f : brep::faces(brep))
    if (!brep::is_convex(brep, f)) concave.push_back(f);
  for (const brep::FaceId f : concave) {
    const auto parts = brep::split_until_convex(brep, f);
    if (parts) continue;
    if (is_flat(brep.data(f).sheet)) return parts.refusal();
    const auto split = brep::first_of(brep::AtNonConvexCorner{}, brep::AtBestEar{});
    if (const auto warped = brep::split_recursively(brep, f, split, brep::Convex{} || brep::triangles); !warped) return warped.refusal();
  }
  return {};
}

}  // namespace raycast::detail
