// SPDX-License-Identifier: MIT
#pragma once
#include <brep/circulators.hpp>
#include <brep/csg/solid.hpp>
#include <brep/result.hpp>
#include <functional>
namespace brep::csg {

// make_solid: a leaf of a CSG tree from a BRep. attribute(FaceId) -> F, position(VertexId) -> glm::dvec3.
template <class F, class B, class Position, class Attribute>
[[nodiscard]] Result<Solid<F>> make_solid(const B& brep, const Grid& grid, Position&& position, Attribute&& attribute);
// The same with data(v).position and data(f).sheet.
template <class B>
[[nodiscard]] Result<Solid<std::uint32_t>> make_solid(const B& brep, const Grid& grid);

template <class F>
[[nodiscard]] Result<Solid<F>> unite(const Solid<F>& a, const Solid<F>& b);
template <class F>
[[nodiscard]] Result<Solid<F>> intersect(const Solid<F>& a, const Solid<F>& b);
template <class F>
[[nodiscard]] Result<Solid<F>> subtract(const Solid<F>& a, const Solid<F>& b);

template <class F>
struct Imprint {
  Solid<F> a, b;                     // cut along each other, nothing is selected
  std::vector<Side> side_a, side_b;  // of each face with respect to the other solid
};
template <class F>
[[nodiscard]] Result<Imprint<F>> imprint(const Solid<F>& a, const Solid<F>& b);

template <class F>
[[nodiscard]] double volume(const Solid<F>& solid);
template <class F>
[[nodiscard]] double area(const Solid<F>& solid);

// set_face(B::face_type&, const F&).
template <class B, class F, class SetFace>
[[nodiscard]] B to_brep(const Solid<F>& solid, SetFace&& set_face);
template <class B, class F>
[[nodiscard]] B to_brep(const Solid<F>& solid);  // data(f).sheet = attribute

struct Collapse {
  std::vector<Element> elements;  // of the BRep of to_brep
  std::string sentence;
};
template <class F>
[[nodiscard]] std::vector<Collapse> check_export(const Solid<F>& solid);

}  // namespace brep::csg
