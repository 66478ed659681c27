// SPDX-License-Identifier: MIT
#pragma once

// The result in a form for pictures and files: positions, faces of three or four corners, a colour at every corner (the half-edge colours
// of paper 4.5), and the radiosity of each face's leaf.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

struct MeshCorner {
  std::uint32_t vertex = 0;  // the half-edge's origin
  Color radiosity{0.0};      // W/m2, as seen from this face
  glm::vec3 normal{0.0f};    // of the true surface there, as seen from this face
};

struct MeshFace {
  std::uint32_t first_corner = 0;
  std::uint32_t corner_count = 0;  // 3 or 4; for shading, a quadrilateral is the triangles 0 1 2 and 0 2 3
  std::uint32_t surface = 0;       // index of the input surface
  std::uint32_t node = no_node;    // hierarchy leaf
  Color radiosity{0.0};            // of the leaf; for a buried one, the mean of its corners
};

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<MeshCorner> corners;
  std::vector<MeshFace> faces;  // counter-clockwise seen from the front
};

}  // namespace radiosity
