// SPDX-License-Identifier: MIT
#pragma once

// The inheritance of attributes: what a new element starts with, and what becomes of the data of a killed one.
//
//   operator                  new element          starts with
//   split_face, cut           face                 a copy of the face that was split (default data if it cannot be copied)
//   split_vertex, unweld      vertex               default data; the vertex that was split is its parent
//   split_edge                vertex               default data; the vertex where the half-edge ends is its parent
//   all that add an edge      two half-edges       default data
//   make_segment              everything           default data
//
//   join_faces, bridge, join_vertices, weld: the element that stays keeps its data; the data of the killed one go.
//
// Faces are copied because a part of a face is still of its material, sheet and level; vertices are not, because a new
// vertex lies elsewhere. A type that wants something else has a member `void inherit(const T& parent)`: it is called on the default
// data of the new element instead of the copy. The solver's surfaces rely on the rule for faces: each part of a split face
// names the sheet and the hierarchy leaf of the whole.

#include <type_traits>

namespace brep::detail {

template <class T>
concept Inheriting = requires(T child, const T& parent) {
  child.inherit(parent);
};

template <class T>
void inherit_face(T& child, const T& parent) {
  if constexpr (Inheriting<T>) {
    child.inherit(parent);
  } else if constexpr (std::is_copy_assignable_v<T> && !std::is_empty_v<T>) {
    child = parent;
  }
}

template <class T>
void inherit_vertex([[maybe_unused]] T& child, [[maybe_unused]] const T& parent) {
  if constexpr (Inheriting<T>) { child.inherit(parent); }
}

}  // namespace brep::detail
