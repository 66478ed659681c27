// SPDX-License-Identifier: MIT
#pragma once

// Does a boundary enclose a solid? It must not intersect itself, no two faces may lie back to back, and every shell must look away from
// what it encloses: outwards, or inwards around a cavity.
//
// Faces are compared pairwise as those of two operands are; all that two may have in common are vertices and edges. Where
// several edges of a boundary coincide, twins are chosen anew by solid wedges, as between operands.

#include <cstdint>
#include <vector>

#include <brep/csg/work.hpp>
#include <brep/handles.hpp>
#include <brep/result.hpp>

namespace brep::csg::detail {

class CheckLeaf {
 public:
  explicit CheckLeaf(Work& work) : work_(work) {}

  std::vector<std::uint32_t> several;  // half-edges of edges that coincide with others

  // The refusal names faces by their attributes.
  [[nodiscard]] Refusal run();

 private:
  [[nodiscard]] FaceId name(std::uint32_t f) const { return FaceId{work_.faces[f].attribute}; }

  [[nodiscard]] Refusal contacts();

  [[nodiscard]] Refusal wedges();

  // Volume times six of the faces of a shell, from the middle of the grid. Exact for vertices on the grid.
  [[nodiscard]] int orientation(const std::vector<std::uint32_t>& shell) const;

  [[nodiscard]] Refusal shells();

  Work& work_;
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/check_leaf.cpp>
#endif
