// SPDX-License-Identifier: MIT
#include <radiosity/scene/frame.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/scene.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::optional<Frame> make_frame(const Scene& scene) {
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
  // The centre is rounded to a grid of a millionth of the size, so that it does not depend on the last bits of the bounds.
  const double grid = std::ldexp(1.0, std::ilogb(extent) - 20);
  const glm::dvec3 centre = glm::round((lo + 0.5 * size) / grid) * grid;
  return Frame{centre, std::ldexp(1.0, -std::ilogb(extent))};
}

HALFLIGHT_INLINE raycast::Scene compile(const Scene& scene, const Frame& frame) {
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
