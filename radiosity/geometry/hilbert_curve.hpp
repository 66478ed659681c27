// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace radiosity {

// The place of a point of the unit cube along Hilbert's curve (1891) through it, on a grid of 2^16 cells a side, by the algorithm of
// Skilling (2004). Points that are near each other on the curve are near each other.
[[nodiscard]] std::uint64_t along_hilbert_curve(const glm::dvec3& point);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/hilbert_curve.cpp>
#endif
