// SPDX-License-Identifier: MIT
#pragma once

// How the normals of a curved object vary over one of its patches. A patch is flat, but the light on the curved surface depends on the
// normal there:
//
//     n(x) = n + S (x - c)          S symmetric only on principal axes, in the plane of the patch; c the centroid
//
// S is fitted to the true normals at the corners by least squares; the remaining error is of second order in the angle by which the patch
// bends. The mean of n(x) is the patch's own normal, so light from one direction brings the same to the surface as to its chord.

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <raycast/transform.hpp>

#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

// S of a patch whose corners lie on this sheet of the object; 0 if the corners do not determine it (a needle).
[[nodiscard]] glm::dmat3 bend_of(const raycast::PlacedObject& object, std::uint32_t sheet, const Patch& patch);

// The unit normal of the surface above the point x of the patch.
[[nodiscard]] inline glm::dvec3 normal_over(const Patch& patch, const glm::dvec3& x) {
  return patch.bent ? glm::normalize(patch.normal + patch.bend * (x - patch.centroid)) : patch.normal;
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/bend.cpp>
#endif
