// SPDX-License-Identifier: MIT
#pragma once

// Placed objects, and the bounds of a scene's surfaces. A room (an object with `inside`) is, as a solid, unbounded: everything outside
// its shape. Its surface is that of the shape, so the bounds of the shape are used.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

// Bounds of the eight placed corners of a box, or of a shape's own bounds; not tight for a rotated shape. NaN gives an empty or infinite
// box, never a finite one that is too small.
[[nodiscard]] inline raycast::Box placed_bounds(const raycast::Box& own, const raycast::Placement& placement) {
  raycast::Box result;
  for (unsigned i = 0; i < 8; ++i) { result.extend(placement.linear * own.corner(i) + placement.translation); }
  return result;
}
[[nodiscard]] inline raycast::Box placed_bounds(const raycast::Object& shape, const raycast::Placement& placement) {
  return placed_bounds(shape.bounds(), placement);
}

// The centres of the six sides of the shape's box, placed. They lie on a sphere and on most other shapes, except for the side of a cone.
[[nodiscard]] inline std::array<glm::dvec3, 6> placed_sides(const raycast::Object& shape, const raycast::Placement& placement) {
  const raycast::Box own = shape.bounds();
  std::array<glm::dvec3, 6> sides{};
  for (int i = 0; i < 6; ++i) {
    glm::dvec3 p = own.centre();
    p[i / 2] = i % 2 == 0 ? own.lo[i / 2] : own.hi[i / 2];
    sides[static_cast<std::size_t>(i)] = placement.linear * p + placement.translation;
  }
  return sides;
}

[[nodiscard]] inline raycast::Box scene_bounds(const Scene& scene) {
  raycast::Box result;
  for (const SceneObject& object : scene.objects) {
    const raycast::Box box = placed_bounds(*object.shape, object.placement);
    result.extend(box.lo);
    result.extend(box.hi);
  }
  return result;
}

[[nodiscard]] inline bool shines_all_over(const Scene& scene, const SceneObject& object) {
  return std::all_of(object.material.begin(), object.material.end(), [&](auto m) { return !is_black(scene.materials[m].emission); });
}

// The bounds of what does not shine all over, so without skies and far suns; of all objects if there is nothing else.
[[nodiscard]] inline raycast::Box lit_bounds(const Scene& scene) {
  raycast::Box result;
  for (const SceneObject& object : scene.objects) {
    if (shines_all_over(scene, object)) { continue; }
    const raycast::Box box = placed_bounds(*object.shape, object.placement);
    result.extend(box.lo);
    result.extend(box.hi);
  }
  return result.empty() ? scene_bounds(scene) : result;
}

// The placed objects of the scene, in scene coordinates.
[[nodiscard]] inline std::vector<raycast::PlacedObject> placed_objects(const Scene& scene) {
  std::vector<raycast::PlacedObject> objects;
  for (const SceneObject& object : scene.objects) { objects.emplace_back(object.shape, object.placement); }
  return objects;
}

}  // namespace radiosity
