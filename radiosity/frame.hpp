// SPDX-License-Identifier: MIT
#pragma once

// The frame in which a run computes: the scene's centre is (nearly) the origin and its size lies in [1, 2). The factor is
// an exact power of two, so a scene scaled by a power of two gives the same bits, and a scene far from the
// origin loses no more than its input had lost already.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <raycast/scene.hpp>

#include <radiosity/scene.hpp>

namespace radiosity {

struct Frame {
  glm::dvec3 centre{0.0};
  double scale = 1.0;  // frame coordinate = (scene coordinate - centre) * scale

  [[nodiscard]] glm::dvec3 to_scene(const glm::dvec3& p) const { return p / scale + centre; }
  [[nodiscard]] double to_scene_area(double area) const { return area / scale / scale; }
};

// The frame of a sound scene; nothing when its bounds are not finite or have no size.
[[nodiscard]] inline std::optional<Frame> make_frame(const Scene& scene) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  glm::dvec3 lo{infinity};
  glm::dvec3 hi{-infinity};
  for (const SceneObject& object : scene.objects) {
    const raycast::Box box = raycast::PlacedObject{object.shape, object.placement}.bounds();
    lo = glm::min(lo, box.lo);
    hi = glm::max(hi, box.hi);
  }
  const glm::dvec3 size = hi - lo;
  const double extent = std::max({size.x, size.y, size.z});
  if (!(extent > 0.0) || !std::isfinite(extent)) { return std::nullopt; }
  // On a grid of a millionth of the size, the centre does not depend on the last bits of the bounds.
  const double grid = std::ldexp(1.0, std::ilogb(extent) - 20);
  const glm::dvec3 centre = glm::round((lo + 0.5 * size) / grid) * grid;
  return Frame{centre, std::ldexp(1.0, -std::ilogb(extent))};
}

// The objects of the scene, compiled for rays in the coordinates of the frame.
[[nodiscard]] inline raycast::Scene compile(const Scene& scene, const Frame& frame) {
  std::vector<raycast::PlacedObject> objects;
  for (const SceneObject& object : scene.objects) {
    raycast::Placement placement = object.placement;
    placement.linear = placement.linear * frame.scale;
    placement.translation = (placement.translation - frame.centre) * frame.scale;
    objects.emplace_back(object.shape, placement);
  }
  return raycast::Scene{std::move(objects)};
}

}  // namespace radiosity
