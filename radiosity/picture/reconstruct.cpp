// SPDX-License-Identifier: MIT
#include <radiosity/picture/reconstruct.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/t_vertices.hpp>

#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::uint64_t eliminate_t_vertices(std::vector<Surface>& surfaces) {
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
[[nodiscard]] HALFLIGHT_INLINE double corner_angle(const SurfaceBRep& brep, brep::HalfedgeId h) {
  const glm::dvec3& p = brep.data(brep.vertex(h)).position;
  const glm::dvec3 a = brep.data(brep.target(h)).position - p;
  const glm::dvec3 b = brep.data(brep.vertex(brep.prev(h))).position - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

HALFLIGHT_INLINE void set_normals(const raycast::PlacedObject& object, SurfaceBRep& brep) {
  for (const brep::FaceId f : brep::faces(brep)) {
    const std::uint32_t sheet = brep.data(f).sheet;
    if (sheet == brep::no_sheet) { continue; }
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      brep.data(h).normal = object.project(sheet, brep.data(brep.vertex(h)).position).normal;
    }
  }
}

}  // namespace detail

HALFLIGHT_INLINE void reconstruct(std::vector<Surface>& surfaces, const Hierarchy& hierarchy, const Exposure& exposure,
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
