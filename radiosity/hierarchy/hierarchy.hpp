// SPDX-License-Identifier: MIT
#pragma once

// The hierarchy: a very primitive tree whose leaves refer to the faces of the BReps (paper 4.2, fig. 3). A node holds the
// centre, normal and area of its patch, and either its children or its face; it has no vertex data and no neighbours. Children
// are consecutive and come after their parent, so a forward pass over the array goes from roots to leaves, and a backward pass
// from leaves to roots.
//
// A root is an input face. A face that is not convex, such as a wall with windows, is an inner node from the start; its children are its
// convex parts.
//
// If a scene has many input faces the tree continues upwards (clusters.hpp): node 0 is then the cluster of all, and clusters and input
// faces come before all other nodes. A cluster has a centre, a radius and an area, but no normal, corners or face.

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
  double radius = 0.0;     // largest distance of a corner from the centre
  double deviation = 0.0;  // sine of the largest angle between the normal and the true normals at the corners; 0 on planes
  double rim = 0.0;        // if the border is curved: how far finer parts may reach outside the contour, within its plane
  std::uint32_t parent = no_node;
  std::uint32_t surface = 0;      // index of the input surface
  std::uint32_t object = 0;       // index of the object and of its Surface
  std::uint32_t first_child = 0;  // when child_count > 0
  std::uint32_t child_count = 0;  // 0: a leaf
  std::uint32_t corners = 0;      // corners of the patch; child k holds corner k of its parent as its corner 0.
                                  // 0: a face whose children are its convex parts.
  brep::FaceId face;              // of a leaf
  // Number of a cluster, else no_node; a cluster has a surface and an object only if all below it share them.
  std::uint32_t cluster = no_node;

  [[nodiscard]] bool leaf() const { return child_count == 0; }
  [[nodiscard]] bool in_parts() const { return child_count > 0 && corners == 0 && !is_cluster(); }
  [[nodiscard]] bool is_cluster() const { return cluster != no_node; }
};

using Hierarchy = BigArray<Node>;

// Is this node an input face? All patches of the face are its descendants.
[[nodiscard]] inline bool is_input_face(const Hierarchy& hierarchy, std::size_t i) {
  return !hierarchy[i].is_cluster() && (hierarchy[i].parent == no_node || hierarchy[hierarchy[i].parent].is_cluster());
}
// The input face to which a patch belongs.
[[nodiscard]] inline std::uint32_t input_face(const Hierarchy& hierarchy, std::uint32_t i) {
  while (!is_input_face(hierarchy, i)) { i = hierarchy[i].parent; }
  return i;
}

}  // namespace radiosity
