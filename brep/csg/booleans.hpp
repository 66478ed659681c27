// SPDX-License-Identifier: MIT
#pragma once

// Union, intersection and difference of exact solids, and the cut of both along each other without a selection.
//
// The operands stay as they are. The result is exact, however deep the tree; it is always a closed 2-manifold with faces as large as they
// can be. Coplanar, touching and identical operands are ordinary: solids that touch in an edge or a vertex stay separate there, solids
// that touch in a face become one. Where both operands have a face in one plane, looking the same way, the attribute is that of a.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/csg/operation.hpp>
#include <brep/csg/solid.hpp>
#include <brep/result.hpp>

namespace brep::csg {

namespace detail {

// The attributes of both operands, one list behind the other, less what no face has.
template <class F>
[[nodiscard]] std::vector<F> attributes_of(const Solid<F>& a, const Solid<F>& b, Boundary& boundary) {
  const std::size_t of_a = a.attributes().size();
  std::vector<std::uint32_t> number(of_a + b.attributes().size(), invalid_index);
  std::vector<F> result;
  for (Face& f : boundary.faces) {
    std::uint32_t& n = number[f.attribute];
    if (n == invalid_index) {
      n = static_cast<std::uint32_t>(result.size());
      result.push_back(f.attribute < of_a ? a.attributes()[f.attribute] : b.attributes()[f.attribute - of_a]);
    }
    f.attribute = n;
  }
  return result;
}

enum class Operation : std::uint8_t { unite, intersect, subtract };

template <class F>
[[nodiscard]] Result<Solid<F>> operate(const Solid<F>& a, const Solid<F>& b, Operation operation) {
  if (!(a.grid() == b.grid())) { return Refusal{Code::different_grids, {}}; }
  const auto of_a = static_cast<std::uint32_t>(a.attributes().size());
  Arrangement arrangement(a.grid().planes(), a.boundary(), b.boundary(), operation == Operation::subtract, of_a);
  const auto value = [&](std::uint32_t i) -> const F& { return i < of_a ? a.attributes()[i] : b.attributes()[i - of_a]; };
  const auto same = [&](std::uint32_t i, std::uint32_t j) { return i == j || value(i) == value(j); };
  Boundary boundary;
  if (!select(arrangement, operation == Operation::unite, same, boundary)) { return Refusal{Code::self_intersecting, {}}; }
  boundary.touching = boundary.touching || a.boundary().touching || b.boundary().touching;
  std::vector<F> attributes = attributes_of(a, b, boundary);
  std::optional<Boundary> largest = with_largest_faces(
      a.grid().planes(), boundary, [&](std::uint32_t i, std::uint32_t j) { return i == j || attributes[i] == attributes[j]; });
  return Solid<F>(a.grid(), std::move(boundary), std::move(largest), std::move(attributes));
}

}  // namespace detail

// What lies in a or in b.     Refused: the operands stand on different grids.     Time: O(v log v) on average; one pass over both
// operands, the rest near the curves where they meet.
template <class F>
[[nodiscard]] Result<Solid<F>> unite(const Solid<F>& a, const Solid<F>& b) {
  return detail::operate(a, b, detail::Operation::unite);
}
// What lies in a and in b. Refusals and time as above.
template <class F>
[[nodiscard]] Result<Solid<F>> intersect(const Solid<F>& a, const Solid<F>& b) {
  return detail::operate(a, b, detail::Operation::intersect);
}
// What lies in a and not in b. Faces that come from b look the other way and keep b's attribute. Refusals and time as above.
template <class F>
[[nodiscard]] Result<Solid<F>> subtract(const Solid<F>& a, const Solid<F>& b) {
  return detail::operate(a, b, detail::Operation::subtract);
}

}  // namespace brep::csg
