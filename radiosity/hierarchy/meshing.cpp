// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/meshing.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/refine.hpp>
#include <brep/ring.hpp>
#include <brep/small_list.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

HALFLIGHT_INLINE void LeafFace::place(brep::VertexId v) const {
  if (surface.topology != Topology::shared || surface.object->flat()) { return; }
  brep::SmallList<std::uint32_t> sheets;
  for (const brep::HalfedgeId h : brep::halfedges_from(surface.brep, v)) {
    sheets.push_back(surface.brep.data(surface.brep.face(h)).sheet);
  }
  glm::dvec3& position = surface.brep.data(v).position;
  position = on_sheets(*surface.object, std::span{sheets.data(), sheets.size()}, position);
}

HALFLIGHT_INLINE ChildFaces RegularMeshing::operator()(const LeafFace& leaf) const {
  SurfaceBRep& brep = leaf.surface.brep;
  const auto place = [&](SurfaceBRep&, brep::VertexId v) { leaf.place(v); };
  const bool ring = leaf.surface.topology == Topology::shared && brep::corners(brep, leaf.face).size() > brep::most_regular_corners;
  auto faces = ring ? brep::cut_ring(brep, leaf.face, place) : brep::refine(brep, leaf.face, place);
  if (!faces) { return {}; }
  return {std::move(*faces), !ring};
}

// Does splitting make the patches of a curved object smaller? The area of flat patches falls to a quarter with each split. Where a
// surface folds within rounding error (the tip of a needle), new vertices coincide with old ones, and one child stays as large as its
// parent for ever. So splitting is given up if four splits together have not reduced the area to that of one.
[[nodiscard]] HALFLIGHT_INLINE bool shrinks(const Hierarchy& hierarchy, std::uint32_t index) {
  std::uint32_t ancestor = index;
  for (int k = 0; k < 4; ++k) {
    if (is_input_face(hierarchy, ancestor)) { return true; }
    ancestor = hierarchy[ancestor].parent;
  }
  return hierarchy[index].area < 0.25 * hierarchy[ancestor].area;
}

HALFLIGHT_INLINE bool subdivide(std::vector<Surface>& surfaces, Hierarchy& hierarchy, std::uint32_t index, const Meshing& meshing) {
  const std::uint32_t object = hierarchy[index].object;
  Surface& surface = surfaces[object];
  if (!surface.object->flat() && !shrinks(hierarchy, index)) { return false; }
  const ChildFaces children = meshing(LeafFace{surface, hierarchy[index].face});
  if (children.faces.empty()) { return false; }
  const auto first = static_cast<std::uint32_t>(hierarchy.size());
  for (const brep::FaceId f : children.faces) {
    hierarchy.push_back(make_leaf(surface, object, f, index, static_cast<std::uint32_t>(hierarchy.size())));
  }
  hierarchy[index].first_child = first;
  hierarchy[index].child_count = static_cast<std::uint32_t>(children.faces.size());
  hierarchy[index].face = brep::FaceId{};
  if (!children.one_a_corner) { hierarchy[index].corners = 0; }
  return true;
}

}  // namespace radiosity
