// SPDX-License-Identifier: MIT
#pragma once

// The hierarchy: a very primitive tree whose leaves stand on the faces of the BReps (paper 4.2, fig. 3). A node
// holds the centre, normal and area of its patch and either its children or its face; no vertex data and no
// neighbours. Children lie side by side and always after their parent, so one pass over the array forwards goes
// from roots to leaves and one pass backwards from leaves to roots.
//
// A root is an input face. One that is not convex, a wall with windows, is an inner node from the start: its children are its convex parts.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/handles.hpp>

namespace radiosity {

inline constexpr std::uint32_t no_node = 0xffffffff;

struct Node {
  glm::dvec3 centre{0.0};
  glm::dvec3 normal{0.0};
  double area = 0.0;
  double radius = 0.0;     // greatest distance of a corner from the centre
  double deviation = 0.0;  // sine of the largest angle to the true normals at the corners; 0 on planes
  std::uint32_t parent = no_node;
  std::uint32_t surface = 0;      // index of the input surface
  std::uint32_t object = 0;       // index of the object and of its Surface
  std::uint32_t first_child = 0;  // when child_count > 0
  std::uint32_t child_count = 0;  // 0: a leaf
  std::uint32_t corners = 0;      // corners of the patch; child k holds corner k of its parent as its corner 0.
                                  // 0: a face in convex parts, its children
  brep::FaceId face;              // when a leaf

  [[nodiscard]] bool leaf() const { return child_count == 0; }
  [[nodiscard]] bool in_parts() const { return child_count > 0 && corners == 0; }
};

using Hierarchy = std::vector<Node>;

}  // namespace radiosity
