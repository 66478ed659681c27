// SPDX-License-Identifier: MIT
#pragma once

// Tag: the split level of a face or vertex (paper, section 2.2, "Class Tag").
//
// Derive it into the attribute types of a BRep:  struct MyVertex : brep::Tag { glm::dvec3 position{0.0}; };
// Regular refinement (refine.hpp) lives on the level: at the start all levels are 0; a face of level l has corners of level <= l, and a
// vertex of higher level on its loop is a T-vertex. The paper's Tag has marks as well; here they are members of the user's own
// attribute types, which new elements inherit like everything else there (inherit.hpp).

#include <cstdint>

namespace brep {

struct Tag {
  std::uint8_t level = 0;
};

}  // namespace brep
