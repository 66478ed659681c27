// SPDX-License-Identifier: MIT
#pragma once

// The solid of a step in space, where its script says where vertices lie: comment lines
//
//     #@ v0 0 0 0  v1 1 0 0
//
// which are no captions. A script is topology alone; coordinates are for the eye.

#include <cstdint>
#include <map>
#include <string>

#include <glm/vec3.hpp>

#include "apps/euler/story.hpp"

namespace apps::euler {

using Coordinates = std::map<std::uint32_t, glm::dvec3>;  // by vertex

// Reads the coordinates and empties their lines, so that the places of statements stay. What is no coordinate is left as a comment.
[[nodiscard]] Coordinates take_coordinates(std::string& text);

// An SVG group around the origin, in a square of this width; empty when the step has no vertex with coordinates. Faces of which a corner
// has none are left out, as are edges.
[[nodiscard]] std::string solid_view(const Frame& frame, const Coordinates& coordinates, double width);

}  // namespace apps::euler
