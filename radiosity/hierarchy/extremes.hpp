// SPDX-License-Identifier: MIT
#pragma once

// The points that bound a scene, in a tree, so that the test whether any of them lies above a plane is fast; it is made for every outer
// surface. Objects with plane faces contribute their vertices, others the corners of their bounds.

#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

class Extremes {
 public:
  Extremes() = default;
  explicit Extremes(const std::vector<Surface>& surfaces);

  // Does any point lie more than `slack` above the plane through `point` with this normal? One descent of the tree, unless very many
  // points lie in the plane.
  [[nodiscard]] bool any_above(const glm::dvec3& point, const glm::dvec3& normal, double slack) const;

 private:
  std::vector<glm::dvec3> points_;
  raycast::Bvh tree_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/extremes.cpp>
#endif
