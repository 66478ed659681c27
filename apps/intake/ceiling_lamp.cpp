// SPDX-License-Identifier: MIT
#include "apps/intake/ceiling_lamp.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
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

struct HangingPlace {
  glm::dvec3 point{0.0};
  double room = 0.0;  // to what is around and below it
};

}  // namespace

std::shared_ptr<const raycast::Object> ceiling_lamp(const radiosity::Scene& scene, const raycast::Box& box) {
  std::vector<raycast::PlacedObject> placed;
  for (const radiosity::SceneObject& object : scene.objects) { placed.emplace_back(object.shape, object.placement); }
  const raycast::Scene objects(std::move(placed));
  constexpr int steps = 9;  // odd: the middle of the room among others
  std::vector<HangingPlace> places;
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
    most = std::max(most, room_here);
    places.push_back({under, room_here});
  }
  if (!(most > 0.0)) { return nullptr; }
  // In a corridor there is as much air all along: then the middle lights most of it.
  constexpr double as_good = 0.9;
  const HangingPlace* best = nullptr;
  const auto off_middle = [&](const HangingPlace& p) { return glm::length(glm::dvec2(p.point) - glm::dvec2(box.centre())); };
  for (const HangingPlace& p : places) {
    if (p.room < as_good * most) { continue; }
    const double nearer = best != nullptr ? off_middle(*best) - off_middle(p) : HUGE_VAL;
    const double equal = 1e-9 * box.diameter();
    if (nearer > equal || (nearer >= -equal && p.room > best->room)) { best = &p; }
  }
  std::vector<glm::dvec3> corners;
  for (const glm::dvec3 corner : {glm::dvec3(-1, -1, 0), glm::dvec3(-1, 1, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, -1, 0)}) {
    corners.push_back(best->point + 0.25 * best->room * corner);
  }
  return raycast::Polygon::make(std::move(corners)).object;
}

}  // namespace apps
