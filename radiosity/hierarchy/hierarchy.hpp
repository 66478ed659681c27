// SPDX-License-Identifier: MIT
#pragma once

// The hierarchy: a very primitive tree whose leaves stand on the faces of the BReps (paper 4.2, fig. 3). A node
// holds the centre, normal and area of its patch and either its children or its face; no vertex data and no
// neighbours. Children lie side by side and always after their parent, so one pass over the array forwards goes
// from roots to leaves and one pass backwards from leaves to roots.
//
// A root is an input face. One that is not convex, a wall with windows, is an inner node from the start: its children are its convex parts.
//
// Where a scene has many input faces the tree goes on upwards (clusters.hpp): node 0 is then a cluster of all, and clusters and input
// faces come before everything else. A cluster has a centre, a radius and an area, and no normal, corners or face.

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include <brep/handles.hpp>

#include <radiosity/support/big_array.hpp>

namespace radiosity {

inline constexpr std::uint32_t no_node = 0xffffffff;

struct Node {
  glm::dvec3 centre{0.0};
  glm::dvec3 normal{0.0};
  double area = 0.0;
  double radius = 0.0;     // greatest distance of a corner from the centre
  double deviation = 0.0;  // sine of the largest angle to the true normals at the corners; 0 on planes
  double rim = 0.0;        // how far finer parts may leave the contour within its plane, where its border is curved
  std::uint32_t parent = no_node;
  std::uint32_t surface = 0;        // index of the input surface
  std::uint32_t object = 0;         // index of the object and of its Surface
  std::uint32_t first_child = 0;    // when child_count > 0
  std::uint32_t child_count = 0;    // 0: a leaf
  std::uint32_t corners = 0;        // corners of the patch; child k holds corner k of its parent as its corner 0.
                                    // 0: a face in convex parts, its children
  brep::FaceId face;                // when a leaf
  std::uint32_t cluster = no_node;  // of a cluster: its number; its surface and object are no_node unless all below share them

  [[nodiscard]] bool leaf() const { return child_count == 0; }
  [[nodiscard]] bool in_parts() const { return child_count > 0 && corners == 0 && !is_cluster(); }
  [[nodiscard]] bool is_cluster() const { return cluster != no_node; }
};

using Hierarchy = BigArray<Node>;

// Is this node an input face, on which all patches below it stand?
[[nodiscard]] inline bool is_input_face(const Hierarchy& hierarchy, std::size_t i) {
  return !hierarchy[i].is_cluster() && (hierarchy[i].parent == no_node || hierarchy[hierarchy[i].parent].is_cluster());
}
// The input face of a patch.
[[nodiscard]] inline std::uint32_t input_face(const Hierarchy& hierarchy, std::uint32_t i) {
  while (!is_input_face(hierarchy, i)) { i = hierarchy[i].parent; }
  return i;
}

}  // namespace radiosity
