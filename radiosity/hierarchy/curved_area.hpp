// SPDX-License-Identifier: MIT
#pragma once

// The area of the part of a curved sheet that a patch represents. A patch is a chord of its surface, and its area is too small by a
// relative amount of second order in its size; with that area it would receive and send too little light. (With the true area the chord
// patch keeps the energy of its surface; the paper's section 5 places refined vertices on the true surface.)

#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/support/draw.hpp>

namespace radiosity {

// The area above a convex polygon with corners on the sheet. Computed from the polygon's triangles and from their quarters with midpoints
// on the surface, extrapolated (Richardson 1911): the relative error is of fourth order in the angle by which the polygon bends. If
// midpoints do not lie above the polygon, because a crease runs through it, the result is the polygon's own area.
[[nodiscard]] inline double curved_area(const raycast::PlacedObject& object, std::uint32_t sheet, const Polygon& polygon) {
  const auto middle = [&](const glm::dvec3& a, const glm::dvec3& b) { return object.vertex(sheet, 0.5 * (a + b)); };
  double chord = 0.0;
  double finer = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
    const glm::dvec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    chord += triangle_area(a, b, c);
    finer += triangle_area(a, ab, ca) + triangle_area(ab, b, bc) + triangle_area(ca, bc, c) + triangle_area(ab, bc, ca);
  }
  const double limit = finer + (finer - chord) / 3.0;
  return limit >= chord && limit <= 1.5 * chord ? limit : chord;
}

}  // namespace radiosity
