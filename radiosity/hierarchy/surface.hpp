// SPDX-License-Identifier: MIT
#pragma once

// The boundary of one object as the solver needs it: a BRep whose vertices, half-edges and faces carry derived
// attributes (paper 2.2, 4.2). Vertices and faces carry level tags; faces know their sheet and their hierarchy
// leaf; half-edges carry the normal and the colour of their origin as seen from their face (paper 4.5).
//
// A vertex inserted by refinement is placed on the object by Object::project, so the mesh follows the true shape as it gets
// finer; on an edge between two sheets it is placed on both.

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/handles.hpp>
#include <brep/tag.hpp>

#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct SurfaceVertex : brep::Tag {
  glm::dvec3 position{0.0};
};

struct SurfaceHalfedge {
  glm::dvec3 normal{0.0};
  Color radiosity{0.0};
};

struct SurfaceFace : brep::Tag {
  std::uint32_t sheet = brep::no_sheet;
  std::uint32_t node = no_node;              // hierarchy leaf of this face
  std::uint32_t part = brep::invalid_index;  // face of the initial convex boundary from which this one was cut
};

using SurfaceBRep = brep::BRep<SurfaceVertex, SurfaceHalfedge, SurfaceFace>;

struct Surface {
  const raycast::PlacedObject* object = nullptr;
  std::uint32_t first_surface = 0;  // index of the input surface of sheet 0
  SurfaceBRep brep;
  Topology topology = Topology::shared;
};

// The approximation of a placed object with convex faces, or a sentence that says why there is none.
struct SurfaceResult {
  std::optional<Surface> surface;
  std::string fault;
};

// Refinement continues from the faces of this approximation. Those of a small curved object are fewer if they would be smaller than
// `least_facet` (a length) otherwise.
[[nodiscard]] SurfaceResult make_surface(const raycast::PlacedObject& object, std::uint32_t first_surface, double least_facet = 0.0);

// Corner positions of a face, beginning with corner 0, without T-vertices.
[[nodiscard]] Polygon corner_polygon(const SurfaceBRep& brep, brep::FaceId f);

// The point near p of a curved object at which these sheets meet, or its projection if it is one sheet; backs (brep::no_sheet) are ignored.
[[nodiscard]] glm::dvec3 on_sheets(const raycast::PlacedObject& object, std::span<const std::uint32_t> sheets, glm::dvec3 p);

// Number of faces that belong to a sheet, that is, those that give and receive light.
[[nodiscard]] std::size_t radiating_faces(const Surface& surface);

// The input faces of a surface, each as its convex parts. A face that is not convex was cut by diagonals; on an object with flat sheets
// its parts are found again by their common sheet. A face that was cut at a wall (wall_cuts.hpp) gives one input face for each part, so
// that no patch spans the wall. Holes and backs are left out.
[[nodiscard]] std::vector<std::vector<brep::FaceId>> input_faces(const Surface& surface);

// One root for each input face of each surface (paper 4.2). Below the root of a face in convex parts, the parts are leaves.
[[nodiscard]] Hierarchy make_roots(std::vector<Surface>& surfaces, std::pmr::memory_resource* arrays = nullptr);

// Makes the leaf of a face, with this index and parent, and stores its index at the face.
[[nodiscard]] Node make_leaf(Surface& surface, std::uint32_t object, brep::FaceId f, std::uint32_t parent, std::uint32_t index);

// The corners of a node: of a leaf, those of its face; of a node in convex parts, the contour of the parts; otherwise corner 0 of each of
// its first children.
[[nodiscard]] Polygon contour(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy, std::uint32_t index);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/surface.cpp>
#endif
