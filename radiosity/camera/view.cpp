// SPDX-License-Identifier: MIT
#include <radiosity/camera/view.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>

#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include <radiosity/scene/bounds.hpp>

namespace radiosity {

HALFLIGHT_INLINE glm::dvec3 View::to_view(const glm::dvec3& world) const {
  const glm::dvec3 p = world - eye;
  return {glm::dot(p, right), glm::dot(p, down), glm::dot(p, forward)};
}

HALFLIGHT_INLINE glm::dvec3 View::ray(double x, double y) const {
  const double pitch = 2.0 * half_width / size.width;
  return {x * pitch - half_width, y * pitch - half_height(), 1.0};
}

HALFLIGHT_INLINE glm::dvec3 View::direction(double x, double y) const {
  const glm::dvec3 r = ray(x, y);
  return r.x * right + r.y * down + forward;
}

// A unit of area at distance r covers the solid angle cos(theta) / r^2. On the plane z = 1, at the angle phi to the axis, a solid angle
// covers 1 / cos(phi)^3 = (r / z)^3 times as much area.
HALFLIGHT_INLINE double View::share(const glm::dvec3& world, const glm::dvec3& normal) const {
  const glm::dvec3 p = to_view(world);
  if (!(p.z > 0.0) || std::abs(p.x) > half_width * p.z || std::abs(p.y) > half_height() * p.z) { return 0.0; }
  return std::max(0.0, glm::dot(normal, eye - world)) / (p.z * p.z * p.z);
}

HALFLIGHT_INLINE View make_view(const Camera& camera, const PictureSize& size) {
  View view;
  view.eye = camera.eye;
  view.forward = glm::normalize(camera.forward);
  view.right = glm::normalize(glm::cross(view.forward, glm::normalize(camera.up)));
  view.down = glm::cross(view.forward, view.right);
  view.half_width = std::tan(0.5 * camera.field_of_view * std::numbers::pi / 180.0);
  view.size = size;
  return view;
}

namespace detail {

// The bounds of the scene without the things that would make the rest small in the picture:
// - strays (bounds_without_strays);
// - lamps far outside, such as a sky behind windows, if all else is less than half as large;
// - flat grounds more than three times as wide as what stands on them;
// - skies that are one object with their ground, of that width. An object counts as a sky if most of its sheets emit, which is not so for a
//   room with a lamp in it.
HALFLIGHT_INLINE raycast::Box worth_seeing(const Scene& scene) {
  struct Thing {
    raycast::Box box;
    bool sky = false;
  };
  const auto shines = [&](std::uint32_t material) { return !is_black(scene.materials[material].emission); };
  const auto add = [](raycast::Box& to, const raycast::Box& box) {
    to.extend(box.lo);
    to.extend(box.hi);
  };
  const raycast::Box all = bounds_without_strays(scene);
  std::vector<Thing> things;
  raycast::Box rest;
  for (const SceneObject& object : scene.objects) {
    if (std::all_of(object.material.begin(), object.material.end(), shines)) { continue; }
    const raycast::Box box = placed_bounds(*object.shape, object.placement);
    if (!all.contains(box.centre())) { continue; }
    const auto shining = std::count_if(object.material.begin(), object.material.end(), shines);
    things.push_back({box, 2 * shining > std::ssize(object.material)});
    add(rest, box);
  }
  std::stable_sort(things.begin(), things.end(), [](const Thing& a, const Thing& b) { return a.box.diameter() < b.box.diameter(); });
  raycast::Box inner;  // bounds of all things smaller than the current one
  const auto around_inner = [&](const Thing& thing) {
    constexpr double thin = 1e-6, wider = 3.0;
    const double width = thing.box.diameter();
    const bool ground = thing.box.size().z < thin * width && thing.box.hi.z <= inner.lo.z + thin * width;
    return width > wider * inner.diameter() && (ground || thing.sky);
  };
  for (auto thing = things.begin(); thing != things.end(); ++thing) {
    if (!inner.empty() && std::all_of(thing, things.end(), around_inner)) {
      rest = inner;
      break;
    }
    add(inner, thing->box);
  }
  return !things.empty() && all.diameter() > 2.0 * rest.diameter() ? rest : all;
}

// Three shares of the rays of a coarse picture, added: those that show a front, among all, which is how large things appear; the same among
// those that meet anything, which is how much of it is no view through backs into the open; and of five directions from each place that is
// seen, upright and at 63 degrees, those in which others lie before it, as walls do before the floor of a room: how much of an inside is
// seen.
HALFLIGHT_INLINE double worth(const raycast::Scene& objects, const Camera& camera) {
  constexpr std::uint32_t across = 24, down = 18;
  const View view = make_view(camera, {across, down});
  std::uint32_t hits = 0, fronts = 0;
  double within = 0.0;
  for (std::uint32_t i = 0; i < across * down; ++i) {
    raycast::Segment ray{view.eye, view.direction(i % across + 0.5, i / across + 0.5)};
    const auto front = seen_front(objects, ray);
    hits += front || ray.origin != view.eye ? 1u : 0u;
    if (!front) { continue; }
    ++fronts;
    const raycast::ScenePoint at = objects.point(*front, ray);
    const glm::dvec3 aside = glm::normalize(glm::cross(at.normal, std::abs(at.normal.z) < 0.5 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0))),
                     along = glm::cross(at.normal, aside);
    for (const glm::dvec2& tilt : {glm::dvec2{0, 0}, glm::dvec2{2, 0}, glm::dvec2{-2, 0}, glm::dvec2{0, 2}, glm::dvec2{0, -2}}) {
      raycast::Segment outwards{at.position, at.normal + tilt.x * aside + tilt.y * along};
      within += seen_front(objects, outwards, at.object, at.sheet) ? 0.2 : 0.0;
    }
  }
  if (fronts == 0) { return 0.0; }
  const double shown = fronts;
  return shown / (across * down) + shown / hits + within / shown;
}

}  // namespace detail

HALFLIGHT_INLINE std::optional<raycast::Hit> seen_front(const raycast::Scene& objects, raycast::Segment& ray, std::uint32_t owner,
                                                        std::uint32_t sheet) {
  constexpr int most = 64;  // limit: only backs are passed, but rounding might repeat one endlessly
  auto hit = objects.closest(ray, owner, sheet);
  for (int passed = 0; passed < most && hit && !hit->front; ++passed) {
    ray.origin += hit->t * ray.direction;
    hit = objects.closest(ray, hit->object, hit->sheet);
  }
  return hit && hit->front ? hit : std::nullopt;
}

HALFLIGHT_INLINE std::array<Camera, 4> outside_cameras(const Scene& scene) {
  const raycast::Box bounds = detail::worth_seeing(scene);
  Camera camera;
  camera.name = "automatic";
  camera.field_of_view = 40.0;
  const glm::dvec3 usual = glm::normalize(glm::dvec3(0.45, 1.0, -0.4));
  // The bounding sphere touches the sides of the narrower, vertical opening of a 4:3 picture.
  const double vertical = std::atan(0.75 * std::tan(0.5 * camera.field_of_view * std::numbers::pi / 180.0));
  const double distance = 0.5 * bounds.diameter() / std::sin(vertical);
  std::array<Camera, 4> cameras;
  std::size_t i = 0;
  for (const glm::dvec2& to :
       {glm::dvec2{usual}, glm::dvec2{-usual.y, usual.x}, glm::dvec2{-usual.x, -usual.y}, glm::dvec2{usual.y, -usual.x}}) {
    const glm::dvec3 forward{to.x, to.y, usual.z};
    camera.forward = distance > 0.0 ? distance * forward : forward;
    camera.eye = bounds.centre() - distance * forward;
    cameras[i++] = camera;
  }
  return cameras;
}

HALFLIGHT_INLINE Camera automatic_camera(const Scene& scene) {
  // A room that is open on one side is viewed through that side, not through the backs of its walls.
  const raycast::Scene objects{placed_objects(scene)};
  constexpr double clearly_more = 0.15;
  const std::array<Camera, 4> cameras = outside_cameras(scene);
  const Camera* best = &cameras.front();
  double most = detail::worth(objects, *best) + clearly_more;
  for (const Camera& camera : std::span(cameras).subspan(1)) {
    const double worth = detail::worth(objects, camera);
    if (worth > most) {
      most = worth;
      best = &camera;
    }
  }
  return *best;
}

}  // namespace radiosity
