// SPDX-License-Identifier: MIT
#pragma once

// The leaf of the hierarchy on which a point of a surface lies.
//
// The input faces of a surface are found through a tree of their boxes, then the hierarchy is gone down: a patch that was split around its
// middle is a fan of children, and the middles of its edges tell which one the point is in; of other children it is the one
// within whose edges the point lies deepest. On a curved surface the point stands in front of the leaf, not in it: an edge counts as the
// plane through it along the normal of its patch. Beside an edge the choice may then fall on the neighbour.

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
  // Of the leaves as they are now; the references must outlive the locator.
  LeafLocator(const Hierarchy& hierarchy, const Patches& patches, std::size_t surface_count);

  // The leaf of this input surface at a point. Its normal tells the sides of a thin curved solid apart; that of a point of a flat surface
  // is not looked at. no_node where the surface has no input face that faces so.
  [[nodiscard]] std::uint32_t operator()(std::uint32_t surface, const raycast::SurfacePoint& at) const;

 private:
  struct InputFaces {
    std::vector<std::uint32_t> nodes;
    raycast::Bvh tree;  // over their boxes, where there are several
  };
  // A node of three or four children around its middle. Child k lies between the lines from the middle to the middles of edges k - 1 and k.
  struct Fan {
    glm::dvec3 middle{0.0};
    std::array<glm::dvec3, 4> across{};  // in the plane, perpendicular to line k, towards child k + 1
    std::uint32_t count = 0;
  };

  void add_fan(std::uint32_t node);
  // How deep within the edges of the patch a point lies; negative outside.
  [[nodiscard]] double depth(std::uint32_t node, const glm::dvec3& x) const;
  [[nodiscard]] std::uint32_t input_face_at(const InputFaces& faces, const raycast::SurfacePoint& at) const;
  [[nodiscard]] std::uint32_t child_at(std::uint32_t node, const glm::dvec3& x) const;

  const Hierarchy* hierarchy_;
  const Patches* patches_;
  std::vector<InputFaces> faces_;  // one an input surface
  std::vector<Fan> fans_;
  std::vector<std::uint32_t> fan_of_;  // of each node: index of its fan, or no_node
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/leaf_locator.cpp>
#endif
