// SPDX-License-Identifier: MIT
#pragma once

// Every face for itself: what it takes until each is a planar simple polygon with an area (raycast::polygon_fault finds nothing), and no
// two faces are the same. A face is nearly planar when its corners leave its plane by at most the tolerance of welding and a ten-thousandth
// of its extent: that is the rounding of six digits, or of single precision. It becomes planar by moving vertices, the others by cuts.

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// Corners that are repeated in a row, and spikes, are taken away. Faces without three corners, without area, or narrower than the tolerance
// are left out.
void drop_degenerate(Working& mesh);

// Faces with the same corners in the same order as a later one are left out: the later one covers the earlier (as objects do).
// `among`: only those faces; empty: all.
void drop_duplicates(Working& mesh, const std::vector<bool>& among = {});

// Faces that are no simple polygons, or not nearly planar, are cut into triangles. `strict`: those that are nearly planar, too.
void split_faulty(Working& mesh, bool strict);

// Moves vertices, each by at most the tolerance of welding, into the planes of the faces around them that are nearly planar.
void flatten(Working& mesh);

// Is this a simple polygon that is planar or nearly so?
[[nodiscard]] bool nearly_sound(std::span<const glm::dvec3> outline, double tolerance);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/clean.cpp>
#endif
