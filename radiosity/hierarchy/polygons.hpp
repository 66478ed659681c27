// SPDX-License-Identifier: MIT
#pragma once

// Polygons that share no vertices: the input of classical hierarchical radiosity (Hanrahan, Salzman and Aupperle 1991), with which the
// paper compares its method. Every face of a boundary becomes a polygon with vertices of its own and the root of a quad-tree; oracle,
// form factors and visibility stay the same. What needs shared topology is lost: vertices that follow a curved surface (the parts of a
// polygon lie in its plane), reconstruction across the edge between two polygons, and the elimination of T-vertices.
//
// Also here: even subdivision of all faces, for methods without a hierarchy.

#include <cassert>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

// Makes each face of an unrefined boundary a separate polygon with a back that belongs to no sheet. Faces without a sheet are left out.
// The faces of a Surface are convex and valid, so this cannot fail.
[[nodiscard]] inline Surface separate_polygons(const Surface& surface) {
  brep::Builder builder;
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    const std::uint32_t sheet = surface.brep.data(f).sheet;
    if (sheet == brep::no_sheet) { continue; }
    std::vector<std::uint32_t> corners;
    for (const glm::dvec3& p : corner_polygon(surface.brep, f)) { corners.push_back(builder.vertex(p)); }
    builder.face(corners, sheet);
    builder.face(std::vector<std::uint32_t>{corners.rbegin(), corners.rend()}, brep::no_sheet);
  }
  auto closed = brep::close<SurfaceBRep>(builder);
  assert(closed.brep);
  return {surface.object, surface.first_surface, std::move(*closed.brep), Topology::separate};
}

// Splits leaves until none is larger than max_area (same unit as the areas of the nodes).
inline void split_evenly(std::vector<Surface>& surfaces, Hierarchy& hierarchy, double max_area) {
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (hierarchy[i].leaf() && hierarchy[i].area > max_area) { (void)subdivide(surfaces, hierarchy, i); }
  }
}

// The area of all roots.
[[nodiscard]] inline double root_area(const Hierarchy& hierarchy) {
  return std::accumulate(hierarchy.begin(), hierarchy.end(), 0.0,
                         [](double sum, const Node& n) { return n.parent == no_node ? sum + n.area : sum; });
}

}  // namespace radiosity
