// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/extremes.hpp>

#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

HALFLIGHT_INLINE Extremes::Extremes(const std::vector<Surface>& surfaces) {
  for (const Surface& surface : surfaces) {
    if (surface.object->exact()) {
      for (const brep::VertexId v : brep::vertices(surface.brep)) { points_.push_back(surface.brep.data(v).position); }
    } else {
      for (unsigned corner = 0; corner < 8; ++corner) { points_.push_back(surface.object->bounds().corner(corner)); }
    }
  }
  std::vector<raycast::Box> boxes;
  boxes.reserve(points_.size());
  for (const glm::dvec3& p : points_) { boxes.push_back({p, p}); }
  tree_ = raycast::Bvh{boxes};
}

HALFLIGHT_INLINE bool Extremes::any_above(const glm::dvec3& point, const glm::dvec3& normal, double slack) const {
  const auto above = [&](const glm::dvec3& p) { return glm::dot(normal, p - point) > slack; };
  const unsigned highest = (normal.x > 0.0 ? 1u : 0u) + (normal.y > 0.0 ? 2u : 0u) + (normal.z > 0.0 ? 4u : 0u);
  return raycast::any_within(
      tree_, [&](const raycast::Box& box) { return above(box.corner(highest)); }, [&](std::uint32_t k) { return above(points_[k]); });
}

}  // namespace radiosity
