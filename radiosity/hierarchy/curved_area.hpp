// SPDX-License-Identifier: MIT
#pragma once

// The area of the part of a curved sheet that a patch stands for. A patch is a chord of its surface and too small by the order of the
// square of its size; counted with its own area it would give and take too little light for what it stands for. (The chord
// patch keeps the energy of its surface: the paper's section 5, refined vertices on the true surface.)

#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>

namespace radiosity {

// Of the sheet over a convex polygon with corners on it. The polygon's triangles and their quarters, with midpoints moved onto the surface,
// are taken to the limit (Richardson 1911): the relative error is of fourth order in the angle over which the polygon bends.
// Where midpoints do not lie over the polygon (a crease runs through it) the polygon's own area is taken.
[[nodiscard]] inline double curved_area(const raycast::PlacedObject& object, std::uint32_t sheet, const Polygon& polygon) {
  const auto area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
  };
  const auto middle = [&](const glm::dvec3& a, const glm::dvec3& b) { return object.vertex(sheet, 0.5 * (a + b)); };
  double chord = 0.0;
  double finer = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
    const glm::dvec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    chord += area(a, b, c);
    finer += area(a, ab, ca) + area(ab, b, bc) + area(ca, bc, c) + area(ab, bc, ca);
  }
  const double limit = finer + (finer - chord) / 3.0;
  return limit >= chord && limit <= 1.5 * chord ? limit : chord;
}

}  // namespace radiosity
