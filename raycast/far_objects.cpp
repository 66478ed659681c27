// SPDX-License-Identifier: MIT
#include <raycast/far_objects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

namespace detail {

// By component, the median of the objects' centres, each counted once for each of its sheets: so a mesh and a sun are not equals.
HALFLIGHT_INLINE glm::dvec3 median_centre(std::span<const PlacedObject> objects) {
  std::vector<std::uint32_t> order(objects.size());
  std::iota(order.begin(), order.end(), 0u);
  std::size_t sheets = 0;
  for (const PlacedObject& object : objects) { sheets += object.sheet_count(); }
  glm::dvec3 middle{0.0};
  for (int k = 0; k < 3; ++k) {
    const auto centre = [&](std::uint32_t i) { return objects[i].bounds().centre()[k]; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
    std::size_t before = 0;
    for (const std::uint32_t i : order) {
      before += objects[i].sheet_count();
      middle[k] = centre(i);
      if (2 * before >= sheets) { break; }
    }
  }
  return middle;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<std::uint32_t> far_objects(std::span<const PlacedObject> objects) {
  constexpr std::size_t most = 16;
  constexpr double apart = 8.0;
  struct Reach {
    std::uint32_t object;
    double nearest, farthest;  // distance from the middle, in the maximum norm
  };
  const auto sound = [](const PlacedObject& object) { return !object.bounds().empty() && std::isfinite(object.bounds().diameter()); };
  if (!std::all_of(objects.begin(), objects.end(), sound)) { return {}; }
  const glm::dvec3 middle = detail::median_centre(objects);
  std::vector<Reach> reaches;
  std::size_t sheets = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    const Box& box = objects[i].bounds();
    Reach reach{i, 0.0, 0.0};  // the surroundings of a room are part of it, so it is never far
    for (int k = 0; k < 3; ++k) {
      if (!objects[i].inside()) { reach.nearest = std::max({reach.nearest, box.lo[k] - middle[k], middle[k] - box.hi[k]}); }
      reach.farthest = std::max({reach.farthest, middle[k] - box.lo[k], box.hi[k] - middle[k]});
    }
    reaches.push_back(reach);
    sheets += objects[i].sheet_count();
  }
  std::sort(reaches.begin(), reaches.end(), [](const Reach& a, const Reach& b) { return a.farthest < b.farthest; });
  std::size_t first_far = objects.size(), far_sheets = 0;
  double nearest = infinity;  // of the objects from i on
  for (std::size_t i = objects.size(); i-- > 1 && objects.size() - i <= most;) {
    nearest = std::min(nearest, reaches[i].nearest);
    far_sheets += objects[reaches[i].object].sheet_count();
    if (10 * far_sheets > sheets) { break; }
    if (nearest > apart * reaches[i - 1].farthest) { first_far = i; }
  }
  std::vector<std::uint32_t> far;
  for (std::size_t i = first_far; i < reaches.size(); ++i) { far.push_back(reaches[i].object); }
  std::sort(far.begin(), far.end());
  return far;
}

}  // namespace raycast
