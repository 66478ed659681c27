// SPDX-License-Identifier: MIT
#pragma once

// Placed objects, and the bounds of a scene's surfaces. A room (an object with `inside`) is, as a solid, unbounded: everything outside
// its shape. Its surface is that of the shape, so the bounds of the shape are used.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
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

// The bounds of at least nine tenths of the objects, if all others lie ten times as far from the middle of most as these reach: files of
// other programs often hold some forgotten parts, kilometres away. Of all objects, if there are no such strays. Time: n log n.
[[nodiscard]] inline raycast::Box bounds_without_strays(const Scene& scene) {
  constexpr double far = 10.0;
  std::vector<raycast::Box> boxes;
  for (const SceneObject& object : scene.objects) {
    boxes.push_back(placed_bounds(*object.shape, object.placement));
    if (!std::isfinite(boxes.back().diameter())) { return scene_bounds(scene); }
  }
  if (boxes.empty()) { return {}; }
  glm::dvec3 middle{0.0};  // by component, the median of the centres
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> centres;
    for (const raycast::Box& box : boxes) { centres.push_back(box.centre()[axis]); }
    const auto half = centres.begin() + static_cast<std::ptrdiff_t>(centres.size() / 2);
    std::nth_element(centres.begin(), half, centres.end());
    middle[axis] = *half;
  }
  const auto nearest = [&](const raycast::Box& box) { return glm::distance(middle, glm::clamp(middle, box.lo, box.hi)); };
  const auto farthest = [&](const raycast::Box& box) {
    return glm::length(glm::max(glm::abs(box.lo - middle), glm::abs(box.hi - middle)));
  };
  std::stable_sort(boxes.begin(), boxes.end(), [&](const auto& a, const auto& b) { return nearest(a) < nearest(b); });
  raycast::Box bounds;
  double reach = 0.0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (10 * i >= 9 * boxes.size() && nearest(boxes[i]) > far * reach) { break; }
    bounds.extend(boxes[i]);
    reach = std::max(reach, farthest(boxes[i]));
  }
  return bounds;
}

[[nodiscard]] inline bool shines(const Scene& scene, const SceneObject& object) {
  return std::any_of(object.material.begin(), object.material.end(), [&](auto m) { return !is_black(scene.materials[m].emission); });
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
