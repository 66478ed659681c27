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
// Time: O(v + sum of the lower degree over the edges), linear for every surface of bounded genus; about 25 ns a quadrilateral in
// warm memory (2-core EPYC). A builder with defects takes some five times as long, for the reports.

#include <cassert>
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
#include <brep/stitch.hpp>

namespace brep {

template <class B>
struct BuildResult {
  std::optional<B> brep;  // exactly when there are no defects
  std::vector<Defect> defects;
};

// Builds the BRep, or reports every defect. Vertex data get `.position`, face data get `.sheet`, if they have such members.
// A defect that is only the consequence of a reported one (the border around a face with a bad index) is not reported.
template <class B>
[[nodiscard]] BuildResult<B> close(const Builder& builder) {
  BuildResult<B> result;
  detail::Assembly assembly;  // the faces that are given by their edges, as corners
  if (!builder.edges().empty()) assembly = detail::Assembler(builder).run();
  const Builder& corners = builder.edges().empty() ? builder : assembly.builder;
  if (assembly.defects.empty() && detail::Stitching<B>(result.brep.emplace(), corners).run()) return result;
  result.brep.reset();
  result.defects = diagnose(builder);
  assert(!result.defects.empty());
  return result;
}

}  // namespace brep
