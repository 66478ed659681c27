// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/geometry/form_factor.hpp>

namespace radiosity {

namespace detail {

// Cuts the faces into triangles and halves needles across their longest edge until none is much longer than wide, into at most 4096 pieces.
[[nodiscard]] std::vector<std::array<glm::dvec3, 3>> compact_triangles(const std::vector<Polygon>& faces);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/geometry/compact_triangles.cpp>
#endif
