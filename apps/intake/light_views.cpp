// SPDX-License-Identifier: MIT
#include "apps/intake/light_views.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/polygon.hpp>

#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/material.hpp>

namespace apps {
namespace {

struct HangingPlace {
  glm::dvec3 point{0.0};
  double room = 0.0;  // smallest distance to anything around and below it
};

}  // namespace

// A surface with less than a hundredth of the largest exitance does not count as a lamp: many programs give every material a little
// emission. Suns, which lie outside of what they light, are not considered for the largest.
LightViews::LightViews(const radiosity::Scene& scene)
    : objects_(radiosity::placed_objects(scene)), size_(radiosity::lit_bounds(scene).diameter()) {
  const std::vector<radiosity::InputSurface> surfaces = radiosity::surfaces(scene);
  const auto exitance = [&](const radiosity::InputSurface& s) { return radiosity::brightest(scene.materials[s.material].emission); };
  double most = 0.0;
  const raycast::Box lit = radiosity::lit_bounds(scene);
  for (const radiosity::InputSurface& surface : surfaces) {
    if (lit.contains(objects_.object(surface.object).bounds().centre())) { most = std::max(most, exitance(surface)); }
  }
  std::vector<const radiosity::InputSurface*> shining;
  std::vector<double> power(scene.objects.size(), 0.0);  // approximate
  for (const radiosity::InputSurface& surface : surfaces) {
    if (!(exitance(surface) > 0.01 * most)) { continue; }
    shining.push_back(&surface);
    const double across = objects_.object(surface.object).bounds().diameter();
    power[surface.object] = std::max(power[surface.object], exitance(surface) * across * across);
  }
  constexpr std::size_t most_points = 64;
  for (std::size_t i = 0; i < std::min(most_points, shining.size()); ++i) {
    const radiosity::InputSurface& surface = *shining[i * shining.size() / std::min(most_points, shining.size())];
    const raycast::PlacedObject& object = objects_.object(surface.object);
    points_.push_back({object.project(surface.sheet, object.bounds().centre()), surface.object, surface.sheet});
  }
  for (std::uint32_t o = 0; o < power.size(); ++o) {
    if (power[o] > 0.0) { lamps_.push_back(o); }
  }
  const auto rank = [&](std::uint32_t o) {
    const glm::dvec3 centre = objects_.object(o).bounds().centre();
    return std::tuple(-power[o], centre.x, centre.y, centre.z);
  };
  std::sort(lamps_.begin(), lamps_.end(), [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
}

bool LightViews::lit(const raycast::ScenePoint& at) const {
  return std::any_of(points_.begin(), points_.end(), [&](const raycast::ScenePoint& lamp) {
    const raycast::PlacedObject& shape = objects_.object(lamp.object);
    raycast::SurfacePoint on = lamp;
    if (!shape.flat()) { on = shape.project(lamp.sheet, at.position); }  // on a curved lamp the nearest point
    const glm::dvec3 way = on.position - at.position;
    return lamp.object == at.object || (glm::dot(way, at.normal) > 0.0 && glm::dot(way, on.normal) < 0.0 &&
                                        !objects_.occluded({at.position, way}, at.object, lamp.object));
  });
}

LightViews::Seen LightViews::seen(const radiosity::Camera& camera, std::uint32_t across, bool with_light) const {
  const radiosity::View view = radiosity::make_view(camera, {across, across * 3 / 4});
  const std::uint32_t rays = view.size.width * view.size.height;
  Seen of;
  for (std::uint32_t i = 0; i < rays; ++i) {
    raycast::Segment ray{view.eye, view.direction(i % across + 0.5, i / across + 0.5)};
    const auto hit = radiosity::seen_front(objects_, ray);
    if (!hit) { continue; }
    of.met += 1.0 / rays;
    if (ray.origin == view.eye) { of.fronts += 1.0 / rays; }
    if (with_light && lit(objects_.point(*hit, ray))) { of.lit += 1.0 / rays; }
  }
  return of;
}

double LightViews::lit_share(const radiosity::Camera& camera) const {
  const Seen of = seen(camera, fine, true);
  return of.met > 0.0 ? of.lit / of.met : 0.0;
}

double LightViews::free_way(const glm::dvec3& from, const glm::dvec3& direction) const {
  const auto hit = objects_.closest({from, direction});
  return hit && hit->front ? hit->t : 0.0;
}

// An opening ends the way like a wall: behind it, the walls beside, the floor and the ceiling are no longer there.
double LightViews::way_in_room(const glm::dvec3& from, const glm::dvec3& direction) const {
  const auto hit = objects_.closest({from, direction});
  if (hit) { return hit->front ? hit->t : 0.0; }
  const glm::dvec3 aside{direction.y, -direction.x, 0.0}, up{0.0, 0.0, 1.0};
  const auto in_room = [&](const glm::dvec3& p) {
    int around = 0;
    for (const glm::dvec3& side : {aside, -aside, up, -up}) { around += free_way(p, side) > 0.0 ? 1 : 0; }
    return around >= 3;  // floor or ceiling may be missing, too
  };
  double inside = 0.0, outside = size_;
  constexpr int halvings = 10;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    (in_room(from + middle * direction) ? inside : outside) = middle;
  }
  return inside;
}

std::optional<radiosity::Camera> LightViews::across_room(glm::dvec3 middle) const {
  constexpr double eye_height = 0.6;  // relative to the distance from floor to ceiling
  middle.z -= (1.0 - eye_height) * free_way(middle, {0, 0, -1});
  struct Across {
    radiosity::Camera camera;
    double way = 0.0, fronts = 0.0;
  };
  std::vector<Across> views;
  double most = 0.0;
  constexpr int directions = 16;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.3) / directions;
    const glm::dvec3 away{std::cos(angle), std::sin(angle), 0.0};
    const double way = way_in_room(middle, away);
    if (!(way > 0.01 * size_)) { continue; }
    radiosity::Camera camera{.name = "inside", .eye = middle + 0.9 * way * away, .field_of_view = 80.0};
    camera.forward = middle - camera.eye;
    // If `middle` is between a lamp and the ceiling close above it, it is too high, so the eye is moved to its height between floor and
    // ceiling.
    const double below = free_way(camera.eye, {0, 0, -1}), above = free_way(camera.eye, {0, 0, 1});
    if (below > 0.0 && above > 0.0) { camera.eye.z += eye_height * (below + above) - below; }
    const double fronts = seen(camera, coarse, false).fronts;
    most = std::max(most, fronts);
    views.push_back({std::move(camera), way, fronts});
  }
  constexpr double as_good = 0.95;
  const Across* best = nullptr;
  for (const Across& view : views) {
    if (view.fronts >= as_good * most && (best == nullptr || view.way > best->way)) { best = &view; }
  }
  if (best == nullptr) { return std::nullopt; }
  // Without a ceiling or a floor, the view is tilted away from the opening, which turns verticals askew: only for clearly more.
  constexpr double clearly_more = 0.05;
  radiosity::Camera camera = best->camera;
  const double length = glm::length(camera.forward);
  double shown = best->fronts;
  for (const double tilt : {-0.2, 0.2, -0.4, 0.4}) {
    radiosity::Camera tilted = best->camera;
    tilted.forward.z = tilt * length;
    const double fronts = seen(tilted, coarse, false).fronts;
    if (fronts > shown + clearly_more) {
      shown = fronts;
      camera = tilted;
    }
  }
  return camera;
}

std::optional<LightViews::Chosen> LightViews::inside() const {
  constexpr std::size_t most_lamps = 8;
  constexpr double enough = 0.5;
  std::optional<Chosen> best;
  const auto look = [&](const glm::dvec3& middle) {
    if (best && best->lit >= enough) { return; }
    std::optional<radiosity::Camera> camera = across_room(middle);
    const double lit = camera ? seen(*camera, fine, true).lit : 0.0;
    if (lit > (best ? best->lit : 0.0)) { best = {std::move(*camera), lit}; }
  };
  const double off = 1e-4 * size_;
  for (std::size_t i = 0; i < std::min(most_lamps, lamps_.size()); ++i) {
    const raycast::Box box = objects_.object(lamps_[i]).bounds();
    look({box.centre().x, box.centre().y, box.lo.z - off});
    look({box.centre().x, box.centre().y, box.hi.z + off});
  }
  for (const raycast::ScenePoint& lamp : points_) { look(lamp.position + off * lamp.normal); }
  return best;
}

std::optional<raycast::Box> LightViews::room_around(const glm::dvec3& eye) const {
  constexpr int directions = 512;
  constexpr double most_open = 0.1;  // a doorway covers a few hundredths of what is seen, a wall or a ceiling that is not there a sixth
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));  // directions of a spiral (Vogel 1979) cover the sphere evenly
  raycast::Box seen;
  int open = 0;
  for (int i = 0; i < directions; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / directions, aside = std::sqrt(1.0 - z * z), angle = golden_angle * i;
    const glm::dvec3 direction{aside * std::cos(angle), aside * std::sin(angle), z};
    const auto hit = objects_.closest({eye, direction});
    if (hit) { seen.extend(eye + hit->t * direction); }
    open += hit ? 0 : 1;
  }
  return open <= most_open * directions ? std::optional{seen} : std::nullopt;
}

std::shared_ptr<const raycast::Object> LightViews::ceiling_lamp(const raycast::Box& box) const {
  constexpr int steps = 9;  // odd, so that the middle of the room is among the positions
  std::vector<HangingPlace> places;
  double most = 0.0;
  for (int i = 0; i < steps * steps * steps; ++i) {
    const glm::dvec3 share{(i % steps + 0.5) / steps, (i / steps % steps + 0.5) / steps, (i / steps / steps + 0.5) / steps};
    const glm::dvec3 point = box.lo + share * box.size();
    const double up = free_way(point, {0, 0, 1});
    if (!(up > 0.0)) { continue; }
    const glm::dvec3 under = point + glm::dvec3(0, 0, 0.95 * up);
    if (objects_.covered(under, {0, 0, -1}, raycast::no_object)) { continue; }  // inside an object
    double room_here = free_way(under, {0, 0, -1});
    for (const glm::dvec3& side : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
      room_here = std::min(room_here, free_way(under, side));
    }
    most = std::max(most, room_here);
    places.push_back({under, room_here});
  }
  if (!(most > 0.0)) { return nullptr; }
  // In a corridor there is equally much air everywhere; then the place nearest to the middle lights most of it.
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
