// SPDX-License-Identifier: MIT
#include "apps/intake/ceiling_lamp.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

namespace apps {
namespace {

// How far it is to the first surface in the direction; 0 when that shows its back, or there is none: the point is not in the room's air.
double free_way(const raycast::Scene& scene, const glm::dvec3& from, const glm::dvec3& direction) {
  const auto hit = scene.closest({from, direction});
  return hit && hit->front ? hit->t : 0.0;
}

}  // namespace

std::shared_ptr<const raycast::Object> ceiling_lamp(const radiosity::Scene& scene, const raycast::Box& box) {
  std::vector<raycast::PlacedObject> placed;
  for (const radiosity::SceneObject& object : scene.objects) { placed.emplace_back(object.shape, object.placement); }
  const raycast::Scene objects(std::move(placed));
  constexpr int steps = 9;  // odd: the middle of the room among others
  glm::dvec3 best{0.0};
  double most = 0.0;
  for (int i = 0; i < steps * steps * steps; ++i) {
    const glm::dvec3 share{(i % steps + 0.5) / steps, (i / steps % steps + 0.5) / steps, (i / steps / steps + 0.5) / steps};
    const glm::dvec3 point = box.lo + share * box.size();
    const double up = free_way(objects, point, {0, 0, 1});
    if (!(up > 0.0)) { continue; }
    const glm::dvec3 under = point + glm::dvec3(0, 0, 0.95 * up);
    if (objects.covered(under, {0, 0, -1}, raycast::no_object)) { continue; }  // in a thing
    double room_here = free_way(objects, under, {0, 0, -1});
    for (const glm::dvec3& side : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
      room_here = std::min(room_here, free_way(objects, under, side));
    }
    if (room_here > (1.0 + 1e-9) * most) {
      most = room_here;
      best = under;
    }
  }
  if (!(most > 0.0)) { return nullptr; }
  std::vector<glm::dvec3> corners;
  for (const glm::dvec3 corner : {glm::dvec3(-1, -1, 0), glm::dvec3(-1, 1, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, -1, 0)}) {
    corners.push_back(best + 0.25 * most * corner);
  }
  return raycast::Polygon::make(std::move(corners)).object;
}

}  // namespace apps
