// SPDX-License-Identifier: MIT
#include <radiosity/picture/met.hpp>

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/direct_light.hpp>

namespace radiosity {

HALFLIGHT_INLINE Met met(const raycast::Scene& objects, const DirectLight& direct, const raycast::Hit& hit, const raycast::Segment& ray) {
  const glm::dvec3 at = ray.at(hit.t);
  const std::uint32_t o = direct.whole(hit.object);
  const raycast::PlacedObject& object = objects.object(o);
  if (!(direct.lift(o) > 0.0)) { return {object.project(hit.sheet, at), o, hit.sheet}; }
  // A mesh that stands in does not know the sheets of its object: it is the nearest that faces the same way.
  const glm::dvec3 normal = direct.objects().object(hit.object).project(hit.sheet, at).normal;
  Met best{object.project(0, at), o, 0};
  double best_distance = glm::dot(best.point.normal, normal) > 0.0 ? glm::length(best.point.position - at) : raycast::infinity;
  for (std::uint32_t s = 1; s < object.sheet_count(); ++s) {
    const raycast::SurfacePoint point = object.project(s, at);
    const double distance = glm::length(point.position - at);
    if (distance < best_distance && glm::dot(point.normal, normal) > 0.0) {
      best = {point, o, s};
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace radiosity
