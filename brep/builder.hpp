// SPDX-License-Identifier: MIT
#pragma once

// The construction phase (paper 2.2): vertices and faces in any order, without a look at consistency; then close().
//
// A Builder is not a template: it collects positions and polygons, and close<MyBRep>(builder) chooses the attributes. So an
// object writes its approximation once and every BRep can be built from it. Each polygon names its sheet: the smooth piece
// of the object's surface to which it belongs (a cylinder has three, a box six, a sphere one).
//
// Faces are counter-clockwise seen from the air. close() either gives the BRep - closed, oriented, one fan at each vertex -
// or all defects at once, each with the elements that take part and a sentence. In defects v3 and f2 are the numbers that
// the builder gave; they are the handles of the finished BRep too: vertex i is VertexId{i}, face i is FaceId{i}, anchored at
// its first corner. What can be repaired, repair.hpp repairs on request.
//
// Time: O(v + sum of the lower degree over the edges), linear for every surface of bounded genus; about 100 ns a quadrilateral
// (2-core EPYC), of which some 40 are the first touch of its memory.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <brep/assemble.hpp>
#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/diagnosis.hpp>
#include <brep/match.hpp>

namespace brep {

template <class B>
struct BuildResult {
  std::optional<B> brep;  // exactly when there are no defects
  std::vector<Defect> defects;
};

namespace detail {
template <class B>
bool stitch(const Builder& builder, std::optional<B>& result);
}

// Builds the BRep, or reports every defect. Vertex data get `.position`, face data get `.sheet`, if they have such members.
// A defect that is only the consequence of a reported one (the border around a face with a bad index) is not reported.
template <class B>
[[nodiscard]] BuildResult<B> close(const Builder& builder) {
  BuildResult<B> result;
  if (builder.edges().empty()) {
    if (detail::stitch(builder, result.brep)) return result;
  } else {
    const detail::Assembly assembly = detail::Assembler(builder).run();
    if (assembly.defects.empty() && detail::stitch(assembly.builder, result.brep)) return result;
  }
  result.defects = diagnose(builder);
  return result;
}

}  // namespace brep

namespace brep::detail {

// Makes the BRep of a builder of corners, if nothing is wrong with it.
template <class B>
bool stitch(const Builder& builder, std::optional<B>& result) {
  const Matching matching(builder);
  if (!matching.sound(builder)) return false;
  B& brep = result.emplace();
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) {
    [[maybe_unused]] auto& data = brep.data(Raw::new_vertex(brep));
    if constexpr (requires { data.position = builder.position(v); }) data.position = builder.position(v);
  }
  for (std::size_t e = 0; e < matching.edges.size(); ++e) (void)Raw::new_edge(brep);
  std::uint32_t corner = 0;
  for (std::uint32_t i = 0; i < builder.face_count(); ++i) {
    const FaceId f = Raw::new_face(brep);
    [[maybe_unused]] auto& data = brep.data(f);
    if constexpr (requires { data.sheet = builder.sheet(i); }) data.sheet = builder.sheet(i);
    const std::span<const std::uint32_t> corners = builder.corners(i);
    const HalfedgeId first{matching.halfedge[corner]};
    HalfedgeId prev{matching.halfedge[corner + corners.size() - 1]}, h = first;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const HalfedgeId next = k + 1 < corners.size() ? HalfedgeId{matching.halfedge[corner + k + 1]} : first;
      Raw::at(brep, h) = {next, prev, VertexId{corners[k]}, f};
      Raw::at(brep, VertexId{corners[k]}).halfedge = h;
      prev = h;
      h = next;
    }
    Raw::at(brep, f).halfedge = first;
    corner += static_cast<std::uint32_t>(corners.size());
  }
  return true;
}

}  // namespace brep::detail
