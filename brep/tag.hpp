// SPDX-License-Identifier: MIT
#pragma once

// Tag: a split level and eight independent marks for faces and vertices (paper, section 2.2, "Class Tag").
//
// Derive it into the attribute types of a BRep:  struct MyVertex : brep::Tag { glm::dvec3 position{0.0}; };
// The level is what regular refinement lives on (refine.hpp): before meshing starts all tags are reset; a face of level l has
// corners of level <= l, and a vertex of higher level on its loop is a T-vertex. The marks belong to the user, who names them by
// the numbers 0 to 7 or by an enumeration of his own:
//
//   enum class Mark { visited, lit };    brep.data(f).mark(Mark::lit);    clear_mark(brep, Mark::visited);

#include <cassert>
#include <concepts>
#include <cstdint>
#include <type_traits>

#include <brep/circulators.hpp>

namespace brep {

template <class T>
concept MarkName = std::integral<T> || std::is_enum_v<T>;

struct Tag {
  std::uint8_t level = 0;
  std::uint8_t marks = 0;

  template <MarkName M>
  void mark(M name) {
    marks = static_cast<std::uint8_t>(marks | bit(name));
  }
  template <MarkName M>
  void unmark(M name) {
    marks = static_cast<std::uint8_t>(marks & ~bit(name));
  }
  template <MarkName M>
  [[nodiscard]] bool marked(M name) const {
    return (marks & bit(name)) != 0;
  }

 private:
  template <MarkName M>
  static unsigned bit(M name) {
    const auto number = static_cast<unsigned>(name);
    assert(number < 8);
    return 1u << (number & 7u);
  }
};

namespace detail {

template <class B, class Change>
void each_tag(B& brep, Change&& change) {
  if constexpr (std::derived_from<typename B::vertex_type, Tag>) {
    for (VertexId v : vertices(brep)) change(static_cast<Tag&>(brep.data(v)));
  }
  if constexpr (std::derived_from<typename B::face_type, Tag>) {
    for (FaceId f : faces(brep)) change(static_cast<Tag&>(brep.data(f)));
  }
}

}  // namespace detail

// Takes one mark from all tagged faces and vertices; the other marks and the levels stay.
template <class B, MarkName M>
void clear_mark(B& brep, M name) {
  detail::each_tag(brep, [&](Tag& tag) { tag.unmark(name); });
}
// All levels 0 and no mark anywhere, as before meshing starts (paper 4.4).
template <class B>
void reset_tags(B& brep) {
  detail::each_tag(brep, [](Tag& tag) { tag = Tag{}; });
}

}  // namespace brep
