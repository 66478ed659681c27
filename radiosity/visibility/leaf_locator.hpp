// SPDX-License-Identifier: MIT
#pragma once

// Finds the leaf of the hierarchy that contains a point of a surface.
//
// The input faces of a surface are found with a tree of their boxes, then the hierarchy is descended. The children of a patch that was
// split around its centre form a fan, and the midpoints of its edges determine in which child the point lies; among other children the
// one is chosen within whose edges the point lies deepest. A point of a curved surface lies in front of the leaf, not in it; an edge then
// stands for the plane through it along the patch's normal. Close to an edge the neighbour may be chosen.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/bvh.hpp>
#include <raycast/object.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

class LeafLocator {
 public:
  // For the current leaves. The references must outlive the locator.
  LeafLocator(const Hierarchy& hierarchy, const Patches& patches, std::size_t surface_count);

  // The leaf of this input surface at a point. The normal distinguishes the sides of a thin curved solid; on a flat surface it is
  // ignored. no_node if the surface has no input face with this orientation.
  [[nodiscard]] std::uint32_t operator()(std::uint32_t surface, const raycast::SurfacePoint& at) const;

 private:
  struct InputFaces {
    std::vector<std::uint32_t> nodes;
    raycast::Bvh tree;  // tree over their boxes, if there are several
  };
  // A node with three or four children around its centre. Child k lies between the lines from the centre to the midpoints of the edges
  // k - 1 and k.
  struct Fan {
    glm::dvec3 middle{0.0};
    std::array<glm::dvec3, 4> across{};  // in the plane, perpendicular to line k, towards child k + 1
    std::uint32_t count = 0;
  };

  void add_fan(std::uint32_t node);
  // Distance of a point from the edges of the patch, positive inside and negative outside. Where that is at most `enough`, so that another
  // patch is the answer, the result is some number between the two.
  [[nodiscard]] double depth(std::uint32_t node, const glm::dvec3& x, double enough) const;
  [[nodiscard]] std::uint32_t input_face_at(const InputFaces& faces, const raycast::SurfacePoint& at) const;
  [[nodiscard]] std::uint32_t child_at(std::uint32_t node, const glm::dvec3& x) const;

  const Hierarchy* hierarchy_;
  const Patches* patches_;
  std::vector<InputFaces> faces_;  // by input surface
  std::vector<Fan> fans_;
  std::vector<std::uint32_t> fan_of_;  // by node: index of its fan, or no_node
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/leaf_locator.cpp>
#endif
