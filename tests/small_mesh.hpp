// SPDX-License-Identifier: MIT
#pragma once

// Small hand-made solutions for tests of what shows or stores them.

#include <initializer_list>
#include <utility>

#include <radiosity/result/mesh.hpp>

// Adds a face with new vertices; counter-clockwise from the bright side.
inline void add_face(radiosity::Mesh& mesh, std::initializer_list<std::pair<glm::dvec3, radiosity::Color>> corners,
                     std::uint32_t surface = 0) {
  radiosity::MeshFace face;
  face.first_corner = static_cast<std::uint32_t>(mesh.corners.size());
  face.corner_count = static_cast<std::uint32_t>(corners.size());
  face.surface = surface;
  for (const auto& [position, color] : corners) {
    mesh.corners.push_back({static_cast<std::uint32_t>(mesh.positions.size()), color});
    mesh.positions.push_back(position);
    face.radiosity += color / static_cast<double>(corners.size());
  }
  mesh.faces.push_back(face);
}
