// SPDX-License-Identifier: MIT
#pragma once

// The matchers of testing.hpp for a mesh structure of your own. Write an adapter with three functions, and
//
//     CHECK_THAT(adapter, IsSolid());                         a closed, oriented manifold; what is wrong is printed in sentences
//     CHECK_THAT(as_brep(adapter), HasCounts({.h = 1}));      and every matcher of BReps
//
// An adapter for vertices and triangles in arrays:
//
//     struct Adapter {
//       const MyMesh& mesh;
//       std::uint32_t vertex_count() const { return mesh.points.size(); }
//       std::uint32_t face_count() const { return mesh.triangles.size(); }
//       auto corners(std::uint32_t f) const { return mesh.triangles[f]; }  // a range of vertex numbers, counter-clockwise from outside
//     };

#include <concepts>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/testing.hpp>

namespace brep {

template <class Mesh>
concept MeshAdapter = requires(const Mesh& mesh, std::uint32_t f) {
  { mesh.vertex_count() } -> std::convertible_to<std::uint32_t>;
  { mesh.face_count() } -> std::convertible_to<std::uint32_t>;
  { *std::begin(mesh.corners(f)) } -> std::convertible_to<std::uint32_t>;
};

// The topology of the mesh; it has no positions, so all of them are 0.
template <MeshAdapter Mesh>
[[nodiscard]] Builder builder_of(const Mesh& mesh) {
  Builder builder;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) { builder.vertex(glm::dvec3(0.0)); }
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<std::uint32_t> corners;
    for (const auto v : mesh.corners(f)) { corners.push_back(static_cast<std::uint32_t>(v)); }
    builder.face(corners, 0);
  }
  return builder;
}

// The mesh as a BRep: vertex i is VertexId{i}, face i is FaceId{i}. An empty BRep when it is no solid.
template <MeshAdapter Mesh>
[[nodiscard]] BRep<> as_brep(const Mesh& mesh) {
  BuildResult<BRep<>> result = close<BRep<>>(builder_of(mesh));
  return result.brep ? std::move(*result.brep) : BRep<>();
}

// Is it a closed manifold whose faces all look the same way?
class IsSolid {
 public:
  static constexpr bool brep_matcher = true;  // so that !IsSolid() can be asked

  template <MeshAdapter Mesh>
  [[nodiscard]] bool match(const Mesh& mesh) const {
    found_.clear();
    const BuildResult<BRep<>> result = close<BRep<>>(builder_of(mesh));
    for (const Defect& defect : result.defects) { found_ += '\n' + defect.sentence; }
    return result.brep.has_value();
  }
  [[nodiscard]] std::string toString() const { return "is a solid" + found_; }

 private:
  mutable std::string found_;
};

}  // namespace brep
