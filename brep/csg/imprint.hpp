// SPDX-License-Identifier: MIT
#pragma once

// Intersection and cutting without selection: both solids with their faces cut along the curves in which they meet.
//
// What a boolean operation does before it selects. A mesher of shadow volumes or of contact surfaces needs just this (paper 5).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/csg/operation.hpp>
#include <brep/csg/solid.hpp>
#include <brep/result.hpp>

namespace brep::csg {

template <class F>
struct Imprint {
  Solid<F> a, b;                     // the operands; faces are cut, attributes copied to the pieces
  std::vector<Side> side_a, side_b;  // of each face with respect to the other operand
};

// Cuts a and b along each other. No face of the results crosses the other solid's boundary; where both have a face in one plane, the
// pieces that cover each other have the same outline. Volumes and areas stay as they are. Refused: the operands stand on different grids.
// Time: as unite.
template <class F>
[[nodiscard]] Result<Imprint<F>> imprint(const Solid<F>& a, const Solid<F>& b) {
  if (!(a.grid() == b.grid())) { return Refusal{Code::different_grids, {}}; }
  detail::Arrangement arrangement(a.grid().planes(), a.boundary(), b.boundary(), false, 0);
  if (arrangement.fault != invalid_index) { return Refusal{Code::self_intersecting, {}}; }
  const auto part = [&](bool of_b, std::vector<Side>& sides) {
    std::vector<std::uint8_t> keep;
    for (std::size_t f = 0; f < arrangement.work.faces.size(); ++f) {
      keep.push_back(arrangement.work.faces[f].of_b == of_b);
      if (keep.back()) { sides.push_back(arrangement.labels.sides[f]); }
    }
    Boundary boundary = detail::Assemble(arrangement.work, std::move(keep)).run();
    boundary.touching = (of_b ? b : a).boundary().touching;
    return Solid<F>(a.grid(), std::move(boundary), std::nullopt, (of_b ? b : a).attributes());
  };
  Imprint<F> result;
  result.a = part(false, result.side_a);
  result.b = part(true, result.side_b);
  return result;
}

}  // namespace brep::csg
