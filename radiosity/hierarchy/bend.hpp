// SPDX-License-Identifier: MIT
#pragma once

// How the normals of a curved object turn over one of its patches. A patch is flat; light that falls on its surface, which is not, varies
// with the normal there:
//
//     n(x) = n + S (x - c)          S symmetric only on principal axes, in the plane of the patch; c the centroid
//
// is fitted to the true normals at the corners by least squares. What the fit leaves is of second order in the angle over which the patch
// bends. The mean of n(x) is the patch's own normal: light from one direction brings to the surface what it brings to the chord.

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <raycast/transform.hpp>

#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

// S of a patch whose corners lie on this sheet of the object; 0 where the corners do not tell (a needle).
[[nodiscard]] glm::dmat3 bend_of(const raycast::PlacedObject& object, std::uint32_t sheet, const Patch& patch);

// The normal of the surface over the point x of the patch.
[[nodiscard]] inline glm::dvec3 normal_over(const Patch& patch, const glm::dvec3& x) {
  return patch.bent ? glm::normalize(patch.normal + patch.bend * (x - patch.centroid)) : patch.normal;
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/bend.cpp>
#endif
