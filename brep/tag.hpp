// SPDX-License-Identifier: MIT
#pragma once

// Tag: a split level and eight marks for faces and vertices (paper, section 2.2, "Class Tag").
//
// Derive it into the attribute types of a BRep:  struct MyVertex : brep::Tag { glm::dvec3 position{0.0}; };
// The level is what regular refinement lives on (refine.hpp): before meshing starts all levels are 0; a face of level l has
// corners of level <= l, and a vertex of higher level on its loop is a T-vertex. The marks belong to the user.

#include <cassert>
#include <cstdint>

namespace brep {

struct Tag {
  std::uint8_t level = 0;
  std::uint8_t marks = 0;

  // Marks are numbered 0 to 7.
  void mark(unsigned bit) {
    assert(bit < 8);
    marks = static_cast<std::uint8_t>(marks | (1u << bit));
  }
  void unmark(unsigned bit) {
    assert(bit < 8);
    marks = static_cast<std::uint8_t>(marks & ~(1u << bit));
  }
  [[nodiscard]] bool marked(unsigned bit) const {
    assert(bit < 8);
    return (marks >> bit & 1u) != 0;
  }
};

}  // namespace brep
