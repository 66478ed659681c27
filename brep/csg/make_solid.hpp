// SPDX-License-Identifier: MIT
#pragma once

// From a BRep to an exact solid: the leaves of a CSG tree.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/csg/assemble.hpp>
#include <brep/csg/check_leaf.hpp>
#include <brep/csg/leaf.hpp>
#include <brep/csg/solid.hpp>
#include <brep/result.hpp>

namespace brep::csg {

// The solid that a BRep encloses, on the grid. position(VertexId) -> glm::dvec3 places its vertices, attribute(FaceId) -> F says what its
// faces carry; neighbours in one plane with equal attributes become one face. Any genus, any number of shells, cavities, bridge edges to
// holes. Vertices move by at most half a spacing of the grid in each coordinate; faces that are not planar then stay whole if three faces
// meet at every vertex (boxes and prisms, however turned), else they fall into triangles (leaf.hpp).
//
// Refused, with the faces: a vertex outside the grid or not finite; a face without area or an edge without length on the grid; a face
// that is not planar and does not look simple; faces that intersect, touch or overlap beyond common edges and vertices; a shell that is
// inside out. The BRep stays as it is.     Time: O(v log v) on average.
template <class F, class B, class Position, class Attribute>
[[nodiscard]] Result<Solid<F>> make_solid(const B& brep, const Grid& grid, Position&& position, Attribute&& attribute) {
  detail::Leaf leaf(grid.planes());
  std::vector<std::uint32_t> number(brep.vertex_end(), invalid_index), place(brep.halfedge_end(), invalid_index);
  for (VertexId v : vertices(brep)) {
    const glm::dvec3 p = position(v);
    if (!grid.contains(p)) { return Refusal{Code::outside_grid, {v, brep.face(brep.halfedge(v))}}; }
    number[v.index] = static_cast<std::uint32_t>(leaf.vertices.size());
    leaf.vertices.push_back(grid.to_grid(p));
  }
  std::vector<F> attributes(brep.face_end());
  std::uint32_t face = 0;
  for (FaceId f : faces(brep)) {
    attributes[f.index] = attribute(f);
    leaf.given.push_back(f.index);
    leaf.anchor.push_back(static_cast<std::uint32_t>(leaf.corners.size()));
    const std::uint32_t first = leaf.anchor.back();
    for (HalfedgeId h : halfedges_of(brep, f)) {
      const auto c = static_cast<std::uint32_t>(leaf.corners.size());
      place[h.index] = c;
      leaf.corners.push_back({number[brep.vertex(h).index], c + 1, c - 1, invalid_index, face});
    }
    leaf.corners[first].prev = static_cast<std::uint32_t>(leaf.corners.size() - 1);
    leaf.corners.back().next = first;
    ++face;
  }
  for (EdgeId e : edges(brep)) {
    const std::uint32_t a = place[halfedge(e).index], b = place[twin(halfedge(e)).index];
    leaf.corners[a].twin = b;
    leaf.corners[b].twin = a;
  }
  Boundary boundary;
  if (const Refusal refusal = leaf.run(boundary); refusal.code != Code::none) { return refusal; }
  detail::Work work(grid.planes());
  work.add(boundary, false, false, 0);
  detail::CheckLeaf check(work);
  if (const Refusal refusal = check.run(); refusal.code != Code::none) { return refusal; }
  detail::Assemble assemble(work, std::vector<std::uint8_t>(work.faces.size(), 1));
  const auto same = [&](std::uint32_t i, std::uint32_t j) { return attributes[i] == attributes[j]; };
  for (std::uint32_t h : check.several) { assemble.hold(h); }
  for (std::uint32_t h = 0; h < work.halves.size(); ++h) { assemble.merge(h, same); }
  assemble.straighten([](std::uint32_t) { return true; });
  boundary = assemble.run();
  std::optional<Boundary> largest = detail::with_largest_faces(grid.planes(), boundary, same);
  return Solid<F>(grid, std::move(boundary), std::move(largest), std::move(attributes));
}

// The same for a BRep whose vertex data have a `position` and whose face data have a `sheet`.
template <class B>
[[nodiscard]] auto make_solid(const B& brep, const Grid& grid) {
  using Sheet = std::remove_cvref_t<decltype(brep.data(FaceId{}).sheet)>;
  return make_solid<Sheet>(
      brep, grid, [&](VertexId v) { return brep.data(v).position; }, [&](FaceId f) { return brep.data(f).sheet; });
}

}  // namespace brep::csg
