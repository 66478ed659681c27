// SPDX-License-Identifier: MIT
#include <radiosity/picture/make_mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/refine.hpp>

#include <raycast/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

namespace detail {

// Does a face of the same sheet with exposed area share a vertex with this one?
[[nodiscard]] HALFLIGHT_INLINE bool touches_exposed(const SurfaceBRep& brep, brep::FaceId f, const Exposure& exposure) {
  const std::uint32_t sheet = brep.data(f).sheet;
  for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
    for (const brep::HalfedgeId l : brep::halfedges_from(brep, brep.vertex(h))) {
      const SurfaceFace& face = brep.data(brep.face(l));
      if (face.sheet == sheet && exposure.area[face.node] > 0.0) { return true; }
    }
  }
  return false;
}

}  // namespace detail

HALFLIGHT_INLINE Mesh make_mesh(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy, const Exposure& exposure,
                                const std::vector<Color>& radiosity) {
  Mesh mesh;
  for (const Surface& surface : surfaces) {
    const SurfaceBRep& brep = surface.brep;
    std::vector<std::uint32_t> index;
    for (const brep::VertexId v : brep::vertices(brep)) {
      if (v.index >= index.size()) { index.resize(v.index + 1, 0); }
      index[v.index] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(brep.data(v).position);
    }
    for (const brep::FaceId f : brep::faces(brep)) {
      const std::uint32_t node = brep.data(f).node;
      if (node == no_node) { continue; }
      const bool buried = !(exposure.area[node] > 0.0);
      if (buried && !detail::touches_exposed(brep, f, exposure)) { continue; }
      // Four corners at most; T-vertex elimination leaves no others, the rest would be cut as a fan. Separate polygons keep their
      // T-vertices, and a leaf is shaded from its own corners.
      std::vector<brep::HalfedgeId> loop;
      if (surface.topology == Topology::separate) {
        for (const brep::HalfedgeId h : brep::corners(brep, f)) { loop.push_back(h); }
      } else {
        for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) { loop.push_back(h); }
      }
      const auto add = [&](std::initializer_list<std::size_t> corners) {
        const auto first = static_cast<std::uint32_t>(mesh.corners.size());
        Color mean{0.0};
        for (const std::size_t k : corners) {
          mesh.corners.push_back({index[brep.vertex(loop[k]).index], brep.data(loop[k]).radiosity});
          mean += brep.data(loop[k]).radiosity / static_cast<double>(corners.size());
        }
        mesh.faces.push_back(
            {first, static_cast<std::uint32_t>(corners.size()), hierarchy[node].surface, node, buried ? mean : radiosity[node]});
      };
      if (loop.size() == 4) {
        add({0, 1, 2, 3});
      } else {
        for (std::size_t k = 1; k + 1 < loop.size(); ++k) { add({0, k, k + 1}); }
      }
    }
  }
  return mesh;
}

}  // namespace radiosity
