// SPDX-License-Identifier: MIT
#pragma once

// The normal of a curved surface at a corner of a patch. On an edge or at a tip, where several sides meet, the surface has no normal;
// each patch then uses the normal of its own side, so that neither colours nor normals are interpolated across the edge.

#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/transform.hpp>

namespace radiosity {

// `corner`: a corner of a patch on this sheet of the object; `inside`: a point in the middle of the patch.
[[nodiscard]] inline glm::dvec3 corner_normal(const raycast::PlacedObject& object, std::uint32_t sheet, const glm::dvec3& corner,
                                              const glm::dvec3& inside) {
  const glm::dvec3 at = object.project(sheet, corner).normal;
  if (object.flat()) { return at; }
  // So close to the corner that the normal of a smooth surface changes by only a thousandth of its change over the patch.
  const glm::dvec3 beside = object.project(sheet, glm::mix(corner, inside, 1e-3)).normal;
  constexpr double smooth = 0.999;  // cosine of some 2.5 degrees
  return glm::dot(at, beside) > smooth ? at : beside;
}

}  // namespace radiosity
