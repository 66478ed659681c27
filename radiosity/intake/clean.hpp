// SPDX-License-Identifier: MIT
#pragma once

// Repairs single faces until each is a planar simple polygon with an area (raycast::polygon_fault finds nothing) and no two faces are the
// same. A face is nearly planar if its corners leave its plane by at most the tolerance of welding and a ten-thousandth of its extent,
// which is the rounding of six digits or of single precision. A nearly planar face is made planar by moving vertices, others by cutting.

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Removes repeated consecutive corners and spikes; then removes faces with fewer than three corners, without area, or narrower than the
// tolerance.
void drop_degenerate(Working& mesh);

// Removes faces with the same corners in the same order as a later one, because the later one covers the earlier (as with objects).
// `among`: only these faces; empty: all. `yielding`: these faces are removed rather than others, whatever their order; empty: none.
void drop_duplicates(Working& mesh, const std::vector<bool>& among = {}, const std::vector<bool>& yielding = {});

// Cuts faces that are not simple polygons, or not nearly planar, into triangles. `strict`: also those that are only nearly planar.
void split_faulty(Working& mesh, bool strict);

// Makes nearly planar faces planar: moves vertices into the planes of the faces around them, each by at most the tolerance of welding.
void flatten(Working& mesh);

// Is this a simple polygon that is planar or nearly so?
[[nodiscard]] bool nearly_sound(std::span<const glm::dvec3> outline, double tolerance);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/clean.cpp>
#endif
