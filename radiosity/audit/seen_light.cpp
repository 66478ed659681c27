// SPDX-License-Identifier: MIT
#include <radiosity/audit/seen_light.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>

#include <radiosity/audit/path_estimates.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/direct/lamp_photons.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::optional<SeenLight> SeenLight::make(const Scene& scene) {
  if (!faults(scene).empty()) { return std::nullopt; }
  const auto emits = [&](const InputSurface& s) { return !is_black(scene.materials[s.material].emission); };
  const std::vector<InputSurface> inputs = surfaces(scene);
  if (std::none_of(inputs.begin(), inputs.end(), emits)) { return std::nullopt; }
  PrepareResult result = prepare(scene);
  if (!result.prepared || !result.prepared->plan.lit) { return std::nullopt; }
  return SeenLight{in_unit(scene, light_unit(scene)), std::move(*result.prepared)};
}

HALFLIGHT_INLINE SeenLight::SeenLight(const Scene& scene, Prepared prepared)
    : prepared_{std::make_unique<Prepared>(std::move(prepared))}, tracer_{scene, prepared_->objects, prepared_->surfaces} {
  // Half as many where rays are expensive, as among curved solids that are cut out of each other.
  const double price = prepared_->objects.ray_work() + prepared_->objects.walk_work();  // of a ray
  constexpr double most_price = 16.0;
  paths_ = price < most_price ? 4 : 2;
  std::vector<Color> emission;
  for (const InputSurface& s : surfaces(scene)) { emission.push_back(scene.materials[s.material].emission); }
  const MeetFront meet = [this](const raycast::ScenePoint& from, const glm::dvec3& direction) { return meet_front(from, direction); };
  usual_ = find_usual(lamp_photons(prepared_->surfaces, emission, meet, prepared_->objects.ray_work()));
}

HALFLIGHT_INLINE double SeenLight::reflected_in_frame(const raycast::ScenePoint& at, std::uint32_t most, std::uint64_t key) const {
  constexpr std::uint64_t seed = 0x7365656eull;
  std::uint64_t rays = 0;
  const PathEstimates light(seed, key, paths_, [&](auto& numbers) { return tracer_.radiosity(at, numbers, rays, most); });
  return std::max(0.0, brightest(0.5 * (light.half(0) + light.half(1)) - tracer_.of(at).emission));
}

HALFLIGHT_INLINE double SeenLight::reflected(const raycast::ScenePoint& at, std::uint32_t most, std::uint64_t key) const {
  raycast::ScenePoint own = at;
  own.position = (at.position - prepared_->frame.centre) * prepared_->frame.scale;
  return reflected_in_frame(own, most, key);
}

HALFLIGHT_INLINE std::optional<raycast::ScenePoint> SeenLight::meet_front(const raycast::ScenePoint& from,
                                                                          const glm::dvec3& direction) const {
  const raycast::Segment ray{from.position, direction * prepared_->objects.diameter()};
  const auto hit = prepared_->objects.closest(from, ray.direction);
  return hit && hit->front ? std::optional{prepared_->objects.point(*hit, ray)} : std::nullopt;
}

// Photons are followed up to the third surface that they meet. What they bring to each is reflected there.
HALFLIGHT_INLINE double SeenLight::find_usual(const std::vector<LampPhoton>& photons) const {
  constexpr std::size_t enough = 128;
  constexpr std::uint32_t surfaces_met = 3, reflections = 5;
  constexpr double most_light = 0.9;
  struct Reflected {
    double level = 0.0, power = 0.0;
  };
  std::vector<Reflected> places;
  double all = 0.0;
  const std::size_t step = std::max<std::size_t>(1, photons.size() / enough);
  for (std::size_t i = 0; i < photons.size(); i += step) {
    Random random{i, 0x7573756c6cull};
    std::optional<raycast::ScenePoint> at = photons[i].landed;
    double power = photons[i].power;
    for (std::uint32_t met = 0; at && met < surfaces_met; ++met) {
      power *= brightest(tracer_.of(*at).reflectance);
      if (!(power > 0.0)) { break; }
      places.push_back({reflected_in_frame(*at, reflections, surfaces_met * i + met), power});
      all += power;
      const double u = random.uniform();
      at = meet_front(*at, cosine_direction(at->normal, u, random.uniform()));
    }
  }
  std::sort(places.begin(), places.end(), [](const Reflected& a, const Reflected& b) { return a.level > b.level; });
  double brighter = 0.0;
  for (const Reflected& place : places) {
    brighter += place.power;
    if (brighter >= most_light * all) { return place.level; }
  }
  return 0.0;
}

HALFLIGHT_INLINE std::vector<raycast::ScenePoint> SeenLight::lamp_points(const Scene& scene, double least, std::size_t most) const {
  std::vector<InputSurface> lamps;
  for (const InputSurface& s : surfaces(scene)) {
    if (brightest(scene.materials[s.material].emission) > least) { lamps.push_back(s); }
  }
  std::vector<raycast::ScenePoint> points;
  const std::size_t count = std::min(most, lamps.size());
  for (std::size_t i = 0; i < count; ++i) {
    const InputSurface& lamp = lamps[i * lamps.size() / count];
    const Surface& surface = prepared_->surfaces[lamp.object];
    double largest = 0.0;
    glm::dvec3 middle{0.0};
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const double area = surface.brep.data(f).sheet == lamp.sheet ? brep::area(surface.brep, f) : 0.0;
      if (!(area > largest)) { continue; }
      largest = area;
      const Polygon corners = corner_polygon(surface.brep, f);  // convex
      middle = std::accumulate(corners.begin(), corners.end(), glm::dvec3(0.0)) / static_cast<double>(corners.size());
    }
    if (!(largest > 0.0)) { continue; }
    const raycast::SurfacePoint on = surface.object->project(lamp.sheet, middle);
    points.push_back({{prepared_->frame.to_scene(on.position), on.normal}, lamp.object, lamp.sheet});
  }
  return points;
}

}  // namespace radiosity
