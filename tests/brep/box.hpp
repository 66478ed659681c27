// SPDX-License-Identifier: MIT
#pragma once

// The axis-parallel box; its sheets 0 to 5 are z-, z+, y-, y+, x-, x+.

#include <brep/builder.hpp>

namespace shapes {

inline brep::Builder box(const glm::dvec3& lo, const glm::dvec3& hi) {
  brep::Builder b;
  for (unsigned i = 0; i < 8; ++i) { b.vertex({(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z}); }
  b.face({0, 2, 3, 1}, 0);
  b.face({4, 5, 7, 6}, 1);
  b.face({0, 1, 5, 4}, 2);
  b.face({2, 6, 7, 3}, 3);
  b.face({0, 4, 6, 2}, 4);
  b.face({1, 3, 7, 5}, 5);
  return b;
}

}  // namespace shapes
