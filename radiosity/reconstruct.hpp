// SPDX-License-Identifier: MIT
#pragma once

// From one radiosity a leaf to a colour at every half-edge, for Gouraud shading (paper 4.5). T-vertices are eliminated
// first, so that neighbouring triangles share their corners. The colour at the origin of half-edge e is
//
//      B_e = sum_l w_l B_face(l) / sum_l w_l        over all half-edges l that leave the same vertex,
//
//   simple    w_l = angle of face(l) at the vertex
//   weighted  w_l = angle * max(0, N_e . N_l), the paper's fig. 5: smooth over a curved surface, and no bleeding over
//             the edge of a box. N is the normal of the true surface there, stored in the half-edge.
//   constant  that of face(e) alone: the solution as it is
//
// The angle makes the average independent of how a T-vertex was connected. Faces of another material, and faces that
// are buried under another object, do not count; a corner with buried faces alone takes the mean of its face's others.
// Constant, a buried face takes the mean of its weighted corners: a sliver of it may show at the foot of what buries it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/circulators.hpp>
#include <brep/refine.hpp>

#include <radiosity/exposure.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/material.hpp>
#include <radiosity/options.hpp>
#include <radiosity/surface.hpp>

namespace radiosity {

// Connects every T-vertex of the leaves to a corner of its face, but for separate polygons. Returns the number of new faces.
inline std::uint64_t eliminate_t_vertices(std::vector<Surface>& surfaces) {
  std::uint64_t added = 0;
  for (Surface& surface : surfaces) {
    if (surface.topology == Topology::separate) { continue; }
    std::vector<brep::FaceId> faces;
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      if (surface.brep.data(f).sheet != brep::no_sheet) { faces.push_back(f); }
    }
    for (const brep::FaceId f : faces) { added += brep::eliminate_t_vertices(surface.brep, f); }
  }
  return added;
}

namespace detail {

// Angle of the face of h at the origin of h.
[[nodiscard]] inline double corner_angle(const SurfaceBRep& brep, brep::HalfedgeId h) {
  const glm::dvec3& p = brep.data(brep.vertex(h)).position;
  const glm::dvec3 a = brep.data(brep.target(h)).position - p;
  const glm::dvec3 b = brep.data(brep.vertex(brep.prev(h))).position - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

inline void set_normals(const raycast::PlacedObject& object, SurfaceBRep& brep) {
  for (const brep::FaceId f : brep::faces(brep)) {
    const std::uint32_t sheet = brep.data(f).sheet;
    if (sheet == brep::no_sheet) { continue; }
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      brep.data(h).normal = object.project(sheet, brep.data(brep.vertex(h)).position).normal;
    }
  }
}

}  // namespace detail

// Fills the half-edge normals and colours of all surfaces. `radiosity` and `exposure` have one entry a node,
// `materials` one a surface.
inline void reconstruct(std::vector<Surface>& surfaces, const Hierarchy& hierarchy, const Exposure& exposure,
                        const std::vector<Color>& radiosity, const std::vector<std::uint32_t>& materials, Reconstruction kind) {
  const bool constant = kind == Reconstruction::constant || kind == Reconstruction::none;
  for (Surface& surface : surfaces) {
    SurfaceBRep& brep = surface.brep;
    detail::set_normals(*surface.object, brep);
    const auto material = [&](std::uint32_t node) { return materials[hierarchy[node].surface]; };
    for (const brep::FaceId f : brep::faces(brep)) {
      const std::uint32_t own = brep.data(f).node;
      if (own == no_node) { continue; }
      if (constant && exposure.area[own] > 0.0) {
        for (const brep::HalfedgeId e : brep::halfedges_of(brep, f)) { brep.data(e).radiosity = radiosity[own]; }
        continue;
      }
      Color face_sum{0.0};  // over the corners that have a colour
      int coloured = 0;
      std::vector<brep::HalfedgeId> bare;
      for (const brep::HalfedgeId e : brep::halfedges_of(brep, f)) {
        Color sum{0.0};
        double weights = 0.0;
        for (const brep::HalfedgeId l : brep::halfedges_from(brep, brep.vertex(e))) {
          const std::uint32_t node = brep.data(brep.face(l)).node;
          if (node == no_node || !(exposure.area[node] > 0.0) || material(node) != material(own)) { continue; }
          double weight = detail::corner_angle(brep, l);
          if (kind != Reconstruction::simple) { weight *= std::max(0.0, glm::dot(brep.data(e).normal, brep.data(l).normal)); }
          sum += weight * radiosity[node];
          weights += weight;
        }
        if (!(weights > 0.0)) {
          bare.push_back(e);
          continue;
        }
        brep.data(e).radiosity = sum / weights;
        face_sum += sum / weights;
        ++coloured;
      }
      const Color mean = coloured > 0 ? face_sum / static_cast<double>(coloured) : radiosity[own];
      for (const brep::HalfedgeId e : bare) { brep.data(e).radiosity = mean; }
      if (constant) {
        for (const brep::HalfedgeId e : brep::halfedges_of(brep, f)) { brep.data(e).radiosity = mean; }
      }
    }
  }
}

}  // namespace radiosity
