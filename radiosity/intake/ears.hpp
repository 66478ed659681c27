// SPDX-License-Identifier: MIT
#pragma once

// Triangles of any polygon, planar or not. It is looked at along its mean normal (Newell), and the best ear is cut off again and again
// (Meisters 1975): the one of which the worse of ear and rest has the best shape, tilt against the mean normal included. So a
// quadrilateral is cut along the better of its two diagonals. A polygon that crosses itself runs out of ears; then the best corner is cut
// off although others lie in its triangle.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace radiosity::intake {

// Corners of the triangles, as indices into `polygon`, which has at least 3 corners; n - 2 of them, some perhaps without area. O(n^2)
// as a rule.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> ears(std::span<const glm::dvec3> polygon);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/ears.cpp>
#endif
