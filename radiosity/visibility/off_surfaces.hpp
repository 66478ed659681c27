// SPDX-License-Identifier: MIT
#pragma once

// Where a camera looks from whose eye is given on a surface, such as on the floor of a room. There, rounding decides on which side it is,
// and half of its rays would meet the surface at no distance, where a pixel has no width.

#include <glm/vec3.hpp>

#include <raycast/scene.hpp>

namespace radiosity {

// The eye, moved into the air before the surfaces on which it lies, to the accuracy of coordinates: by a millionth of the diameter
// of the scene, or half way to what is before it if that is nearer. In the coordinates of the objects; elsewhere, the eye itself.
[[nodiscard]] glm::dvec3 off_surfaces(const raycast::Scene& objects, const glm::dvec3& eye);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/off_surfaces.cpp>
#endif
