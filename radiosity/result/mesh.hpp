// SPDX-License-Identifier: MIT
#pragma once

// The result as a picture or a file wants it: positions, faces of three or four corners, a colour at every corner (the half-edge
// colours of paper 4.5) and the radiosity of the leaf that the face belongs to.
// Buried leaves are left out, but for those that touch an exposed one: a curved object stands in front of its chords, and what
// shows between the two must not be a hole.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

struct MeshCorner {
  std::uint32_t vertex = 0;  // the half-edge's origin
  Color radiosity{0.0};      // W/m2, as seen from this face
};

struct MeshFace {
  std::uint32_t first_corner = 0;
  std::uint32_t corner_count = 0;  // 3 or 4; for shading, a quadrilateral is the triangles 0 1 2 and 0 2 3
  std::uint32_t surface = 0;       // index of the input surface
  std::uint32_t node = no_node;    // hierarchy leaf
  Color radiosity{0.0};            // of the leaf; of a buried one, the mean of its corners
};

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<MeshCorner> corners;
  std::vector<MeshFace> faces;  // counter-clockwise from the bright side
};

// Positions are in the frame.
[[nodiscard]] Mesh make_mesh(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy, const Exposure& exposure,
                             const std::vector<Color>& radiosity);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/result/mesh.cpp>
#endif
