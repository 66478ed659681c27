// SPDX-License-Identifier: MIT
#include <raycast/objects/csg_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/polygon.hpp>
#include <brep/result.hpp>
#include <brep/small_list.hpp>
#include <brep/split.hpp>
#include <brep/unchecked.hpp>

#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

namespace detail {

HALFLIGHT_INLINE void take_away_slivers(CsgBRep& brep) {
  std::vector<brep::FaceId> thin;
  for (const brep::FaceId f : brep::faces(brep)) {
    const auto corners = brep::positions(brep, f);
    const double size = brep::extent(corners);
    if (!(brep::area(corners) > tol_thin_face * size * size) && !brep::is_convex(corners)) { thin.push_back(f); }
  }
  for (const brep::FaceId f : thin) {
    if (!brep.alive(f)) { continue; }
    brep::HalfedgeId longest{};
    double length = -1.0;
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      const double l = glm::length(brep.data(brep.target(h)).position - brep.data(brep.vertex(h)).position);
      if (brep.face(brep::twin(h)) == f || l <= length) { continue; }
      longest = brep::twin(h);
      length = l;
    }
    if (length < 0.0) { continue; }
    const brep::FaceId g = brep::unchecked::join_faces(brep, longest);
    for (bool again = true; again;) {  // further common edges leave a spur
      again = false;
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, g)) {
        if (brep.next(h) != brep::twin(h) || brep.next(brep::twin(h)) == h) { continue; }
        brep::unchecked::join_vertices(brep, h);  // the target is merged into the origin
        again = true;
        break;
      }
    }
  }
}

HALFLIGHT_INLINE std::string cut_into_convex_parts(CsgBRep& brep, const CsgTree& tree) {
  std::vector<brep::FaceId> concave;
  for (const brep::FaceId f : brep::faces(brep)) {
    if (!brep::is_convex(brep, f)) { concave.push_back(f); }
  }
  for (const brep::FaceId f : concave) {
    if (const auto parts = brep::split_nearly_simple(brep, f); !parts) {
      return "a face of '" + std::string(tree.sheet_name(brep.data(f).sheet)) +
             "' cannot be cut into convex parts: " + parts.refusal().sentence();
    }
  }
  return {};
}

HALFLIGHT_INLINE void tell_edges_apart(CsgBRep& brep) {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, brep::EdgeId>> ends;
  for (const brep::EdgeId e : brep::edges(brep)) {
    const std::uint32_t a = brep.vertex(brep::halfedge(e)).index, b = brep.target(brep::halfedge(e)).index;
    ends.emplace_back(std::min(a, b), std::max(a, b), e);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const auto& [a, b, e] = ends[i];
    if (std::get<0>(ends[i - 1]) != a || std::get<1>(ends[i - 1]) != b) { continue; }
    const glm::dvec3 middle = 0.5 * (brep.data(brep::VertexId{a}).position + brep.data(brep::VertexId{b}).position);
    brep.data(brep.vertex(brep::unchecked::split_edge(brep, brep::halfedge(e)))).position = middle;
  }
}

}  // namespace detail

}  // namespace raycast
