// SPDX-License-Identifier: MIT
#pragma once

// Polygons that share nothing with one another: the input of classical hierarchical radiosity (Hanrahan, Salzman and Aupperle 1991), with
// which the paper compares itself. Every face of a boundary becomes a polygon with vertices of its own and is the root of a quad-tree of
// its own; oracle, form factors and visibility stay the same. All that needs shared topology is lost: vertices that follow a curved surface
// (the parts of a polygon lie in its plane), reconstruction across the edge between two polygons, and the elimination of T-vertices.
//
// Also here: cutting all faces evenly, for methods without a hierarchy.

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

// The faces of an unrefined boundary as polygons of their own, each with a back that belongs to no sheet. What had no sheet before
// is left out. The faces of a Surface are convex and proper, so this cannot fail.
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

// Splits leaves until none is larger than max_area (in the unit of the node areas).
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
