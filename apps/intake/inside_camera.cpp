// SPDX-License-Identifier: MIT
#include "apps/intake/inside_camera.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include "apps/view.hpp"

namespace apps {
namespace {

struct LampPoint {
  std::uint32_t object = 0;
  raycast::SurfacePoint at;
};

// A point of each of the first lamps. What shines less than a hundredth as bright as the brightest is no lamp: many programs give every
// material a little light of its own.
std::vector<LampPoint> lamp_points(const radiosity::Scene& scene, const raycast::Scene& objects) {
  constexpr std::size_t most = 16;
  const std::vector<radiosity::InputSurface> surfaces = radiosity::surfaces(scene);
  const auto exitance = [&](const radiosity::InputSurface& surface) {
    const radiosity::Color& emission = scene.materials[surface.material].emission;
    return std::max({emission.r, emission.g, emission.b});
  };
  double brightest = 0.0;
  for (const radiosity::InputSurface& surface : surfaces) { brightest = std::max(brightest, exitance(surface)); }
  std::vector<LampPoint> points;
  for (const radiosity::InputSurface& surface : surfaces) {
    if (points.size() >= most || !(exitance(surface) > 0.01 * brightest)) { continue; }
    const raycast::PlacedObject& object = objects.object(surface.object);
    points.push_back({surface.object, object.project(surface.sheet, object.bounds().centre())});
  }
  return points;
}

// Does the light of a lamp come straight to this camera by way of a surface, or does it see the lamp?
bool sees_light(const Camera& camera, const radiosity::Scene& scene, const raycast::Scene& objects, const std::vector<LampPoint>& lamps) {
  const glm::dvec3 forward = glm::normalize(camera.forward), right = glm::normalize(glm::cross(forward, camera.up)),
                   up = glm::cross(right, forward);
  const double half = std::tan(0.5 * camera.field_of_view * std::numbers::pi / 180.0);
  constexpr int across = 24, down = 18;
  const std::vector<radiosity::InputSurface> surfaces = radiosity::surfaces(scene);
  for (int i = 0; i < across * down; ++i) {
    const double x = 2.0 * (i % across + 0.5) / across - 1.0, y = 0.75 * (1.0 - 2.0 * (i / across + 0.5) / down);
    const auto hit = objects.closest({camera.eye, forward + half * (x * right + y * up)});
    if (!hit || !hit->front) { continue; }
    const raycast::SurfacePoint at =
        objects.object(hit->object).project(hit->sheet, camera.eye + hit->t * (forward + half * (x * right + y * up)));
    for (const LampPoint& lamp : lamps) {
      if (lamp.object == hit->object) { return true; }
      const glm::dvec3 way = lamp.at.position - at.position;
      if (glm::dot(way, at.normal) > 0.0 && glm::dot(way, lamp.at.normal) < 0.0 &&
          !objects.occluded({at.position, way}, hit->object, lamp.object)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::optional<Camera> inside_camera(const radiosity::Scene& scene) {
  std::vector<raycast::PlacedObject> placed;
  for (const radiosity::SceneObject& object : scene.objects) { placed.emplace_back(object.shape, object.placement); }
  const raycast::Scene objects(std::move(placed));
  const std::vector<LampPoint> lamps = lamp_points(scene, objects);
  if (lamps.empty() || sees_light(automatic_camera(scene), scene, objects, lamps)) { return std::nullopt; }
  const auto free_way = [&](const glm::dvec3& from, const glm::dvec3& direction) {
    const auto hit = objects.closest({from, direction});
    return hit && hit->front ? hit->t : 0.0;
  };
  glm::dvec3 middle = lamps[0].at.position + 1e-4 * objects.diameter() * lamps[0].at.normal;
  middle.z -= 0.4 * free_way(middle, {0, 0, -1});
  glm::dvec3 away{0.0};
  double most = 0.01 * objects.diameter();
  constexpr int directions = 16;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.3) / directions;
    const glm::dvec3 direction{std::cos(angle), std::sin(angle), 0.0};
    const double way = free_way(middle, direction);
    if (way > most) {
      most = way;
      away = direction;
    }
  }
  if (away == glm::dvec3{0.0}) { return std::nullopt; }
  Camera camera;
  camera.name = "inside";
  camera.eye = middle + 0.9 * most * away;
  camera.forward = -away;
  camera.field_of_view = 80.0;
  return camera;
}

}  // namespace apps
