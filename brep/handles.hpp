// SPDX-License-Identifier: MIT
#pragma once

// Handles: the names of the elements of a BRep.
//
// A handle is one 32-bit index with a type, so a vertex cannot be taken for a face. It stays the same while its element
// lives; after the element was killed its slot, and with it the handle, is used again (last killed, first reused).
// An edge is two half-edges that lie side by side: edge e has the half-edges 2e and 2e + 1, hence twin and edge cost
// one instruction and need no memory. A default-constructed handle names nothing.
//
// Printed as v3 h7 e3 f1, in every sentence of this library.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace brep {

inline constexpr std::uint32_t invalid_index = 0xffffffff;

template <char Letter>
struct Id {
  std::uint32_t index = invalid_index;

  [[nodiscard]] constexpr bool valid() const { return index != invalid_index; }
  friend constexpr bool operator==(Id, Id) = default;
  friend constexpr auto operator<=>(Id, Id) = default;
};

using VertexId = Id<'v'>;
using HalfedgeId = Id<'h'>;
using EdgeId = Id<'e'>;
using FaceId = Id<'f'>;

// The other half of the same edge: it runs the opposite way and lies on the other side.
[[nodiscard]] constexpr HalfedgeId twin(HalfedgeId h) { return HalfedgeId{h.index ^ 1u}; }
[[nodiscard]] constexpr EdgeId edge(HalfedgeId h) { return EdgeId{h.index >> 1}; }
// The first half of the edge; the second is its twin.
[[nodiscard]] constexpr HalfedgeId halfedge(EdgeId e) { return HalfedgeId{e.index << 1}; }

// An element of any kind, for reports. The letter is 0 when it names nothing.
struct Element {
  char letter = 0;
  std::uint32_t index = invalid_index;

  constexpr Element() = default;
  template <char Letter>
  constexpr Element(Id<Letter> id) : letter(Letter), index(id.index) {}  // implicit: every handle is an element
  friend constexpr bool operator==(Element, Element) = default;
};

[[nodiscard]] inline std::string to_string(Element e) {
  if (e.letter == 0) { return "nothing"; }
  std::string text(1, e.letter);
  text += e.index == invalid_index ? std::string("?") : std::to_string(e.index);
  return text;
}
template <char Letter>
[[nodiscard]] std::string to_string(Id<Letter> id) {
  return to_string(Element(id));
}

}  // namespace brep

template <char Letter>
struct std::hash<brep::Id<Letter>> {
  std::size_t operator()(brep::Id<Letter> id) const noexcept { return std::hash<std::uint32_t>()(id.index); }
};
