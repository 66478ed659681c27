// SPDX-License-Identifier: MIT
#include "apps/intake/light_views.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/audit/seen_light.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/random.hpp>

namespace apps {
namespace {

constexpr std::uint32_t reflections = 5;  // that light has had which a picture will show

// The value below which this share of all values lies; 0 if there are none.
double share_below(std::vector<double> values, double share) {
  if (values.empty()) { return 0.0; }
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

// A surface with less than a hundredth of the largest exitance does not count as a lamp: many programs give every material a little
// emission. Suns, which lie outside of what they light, are not considered for the largest.
LightViews::LightViews(const radiosity::Scene& scene)
    : objects_(radiosity::placed_objects(scene)),
      size_(radiosity::lit_bounds(scene).diameter()),
      light_(radiosity::SeenLight::make(scene)) {
  const std::vector<radiosity::InputSurface> surfaces = radiosity::surfaces(scene);
  const auto exitance = [&](const radiosity::InputSurface& s) { return radiosity::brightest(scene.materials[s.material].emission); };
  double most = 0.0;
  const raycast::Box lit = radiosity::lit_bounds(scene);
  for (const radiosity::InputSurface& surface : surfaces) {
    if (lit.contains(objects_.object(surface.object).bounds().centre())) { most = std::max(most, exitance(surface)); }
  }
  const double least = 0.01 * most;
  std::vector<double> power(scene.objects.size(), 0.0);  // approximate
  for (const radiosity::InputSurface& surface : surfaces) {
    if (!(exitance(surface) > least)) { continue; }
    shine_.insert({surface.object, surface.sheet});
    const double across = objects_.object(surface.object).bounds().diameter();
    power[surface.object] = std::max(power[surface.object], exitance(surface) * across * across);
  }
  constexpr std::size_t most_points = 64;
  if (light_) { points_ = light_->lamp_points(scene, least, most_points); }
  for (std::uint32_t o = 0; o < power.size(); ++o) {
    if (power[o] > 0.0) { lamps_.push_back(o); }
  }
  const auto rank = [&](std::uint32_t o) {
    const glm::dvec3 centre = objects_.object(o).bounds().centre();
    return std::tuple(-power[o], centre.x, centre.y, centre.z);
  };
  std::sort(lamps_.begin(), lamps_.end(), [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
}

LightViews::Light LightViews::light(const std::vector<raycast::ScenePoint>& points, std::uint32_t most) const {
  Light of;
  if (!light_) { return of; }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (shine_.contains({points[i].object, points[i].sheet})) {
      ++of.lamps;
    } else {
      of.reflected.push_back(light_->reflected(points[i], most, i));
    }
  }
  return of;
}

LightViews::Seen LightViews::seen(const radiosity::Camera& camera, std::uint32_t across) const {
  const radiosity::View view = radiosity::make_view(camera, {across, across * 3 / 4});
  const std::uint32_t rays = view.size.width * view.size.height;
  Seen of;
  for (std::uint32_t i = 0; i < rays; ++i) {
    raycast::Segment ray{view.eye, view.direction(i % across + 0.5, i / across + 0.5)};
    const auto hit = radiosity::seen_front(objects_, ray);
    if (!hit) { continue; }
    if (ray.origin == view.eye) { of.fronts += 1.0 / rays; }
    of.points.push_back(objects_.point(*hit, ray));
  }
  of.met = static_cast<double>(of.points.size()) / rays;
  return of;
}

double LightViews::lit_share(const radiosity::Camera& camera) const {
  const Seen of = seen(camera, fine);
  if (of.points.empty()) { return 0.0; }
  const Light direct = light(of.points, 1);
  const auto lit = std::ranges::count_if(direct.reflected, [](double light) { return light > 0.0; });
  return static_cast<double>(direct.lamps + static_cast<std::size_t>(lit)) / static_cast<double>(of.points.size());
}

double LightViews::reflected_share(const radiosity::Camera& camera, std::span<const raycast::Box> rooms) const {
  constexpr std::uint32_t rays = 64;  // from each point
  const std::vector<raycast::ScenePoint> from = seen(camera, fine).points;
  std::vector<raycast::ScenePoint> met;
  for (std::size_t i = 0; i < from.size(); ++i) {
    radiosity::Random random{1, i};
    const glm::dvec3 start = from[i].position + 1e-6 * size_ * from[i].normal;
    for (std::uint32_t k = 0; k < rays; ++k) {
      const double u = random.uniform();
      raycast::Segment ray{start, radiosity::cosine_direction(from[i].normal, u, random.uniform())};
      const auto hit = radiosity::seen_front(objects_, ray);
      if (!hit) { continue; }
      const raycast::ScenePoint at = objects_.point(*hit, ray);
      const auto holds = [&](const raycast::Box& room) { return room.grown(1e-6 * size_).contains(at.position); };
      if (std::any_of(rooms.begin(), rooms.end(), holds)) { met.push_back(at); }
    }
  }
  const std::vector<double> direct = light(met, 1).reflected;
  const auto lit = std::ranges::count_if(direct, [](double light) { return light > 0.0; });
  return from.empty() ? 0.0 : static_cast<double>(lit) / static_cast<double>(from.size() * rays);
}

double LightViews::shown(const Seen& of, double usual) const {
  constexpr double black = 0.002;  // relative to what is shown bright: 5 of 255 levels
  constexpr double faint = 0.01;   // relative to what is usual
  if (of.points.empty()) { return 0.0; }
  const Light all = light(of.points, reflections);
  const double least = std::max(faint * usual, black * share_below(all.reflected, 0.98));  // as radiosity::automatic_exposure
  const auto bright = std::ranges::count_if(all.reflected, [&](double light) { return light > 0.0 && light >= least; });
  return static_cast<double>(all.lamps + static_cast<std::size_t>(bright)) / static_cast<double>(of.points.size());
}

double LightViews::shown_share(const radiosity::Camera& camera, double usual) const { return shown(seen(camera, fine), usual); }

double LightViews::bright_share(const radiosity::Camera& camera, double usual) const {
  const Seen of = seen(camera, fine);
  return of.met * shown(of, usual);
}

double LightViews::lamp_share(const radiosity::Camera& camera) const {
  const Seen of = seen(camera, fine);
  if (of.points.empty()) { return 0.0; }
  const auto lamps = std::ranges::count_if(of.points, [&](const raycast::ScenePoint& at) {
    return shine_.contains({at.object, at.sheet});
  });
  return static_cast<double>(lamps) / static_cast<double>(of.points.size());
}

std::size_t LightViews::surfaces(const radiosity::Camera& camera) const {
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen_there;
  for (const raycast::ScenePoint& at : seen(camera, finest).points) { seen_there.insert({at.object, at.sheet}); }
  return seen_there.size();
}

double LightViews::usual_light(const std::optional<Chosen>& inside) const {
  if (!light_ || !inside) { return 0.0; }
  return std::min(light_->usual(), share_below(light(seen(inside->camera, fine).points, reflections).reflected, 0.5));
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
    const double fronts = seen(camera, coarse).fronts;
    most = std::max(most, fronts);
    views.push_back({std::move(camera), way, fronts});
  }
  constexpr double as_good = 0.97;
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
    const double fronts = seen(tilted, coarse).fronts;
    if (fronts > shown + clearly_more) {
      shown = fronts;
      camera = tilted;
    }
  }
  return camera;
}

// Many lamps stand in niches, behind letters or close to a wall, from where next to nothing is seen. So of the views that show about as
// much light and as few openings as any, the one that sees furthest is taken.
std::optional<LightViews::Chosen> LightViews::inside() const {
  constexpr std::size_t most_lamps = 8;
  constexpr double enough = 0.5, as_bright = 0.8, as_closed = 0.95, in_air = 0.9, blocked = 0.1;
  struct Candidate {
    Chosen view;
    double met = 0.0;  // share of the rays that meet anything
  };
  std::vector<Candidate> views, close;  // close: before something that fills half of the picture; only if there are no others
  double most_of_rooms = 0.0;           // light that a view shows which sees further than a nook
  const auto look = [&](const glm::dvec3& middle) {
    const std::optional<radiosity::Camera> camera = across_room(middle);
    if (!camera) { return; }
    const Seen of = seen(*camera, coarse);
    if (of.fronts < in_air * of.met) { return; }  // in a solid, the backs of which it sees
    std::vector<double> distances;
    for (const raycast::ScenePoint& at : of.points) { distances.push_back(glm::length(at.position - camera->eye)); }
    const double reach = share_below(distances, 0.5);
    const Candidate view{{*camera, of.met * shown(of, 0.0), reach / size_}, of.met};
    if (reach < blocked * share_below(std::move(distances), 0.9)) { return close.push_back(view); }
    views.push_back(view);
    if (view.view.reach >= nook) { most_of_rooms = std::max(most_of_rooms, view.view.lit); }
  };
  const double off = 1e-4 * size_;
  for (std::size_t i = 0; i < std::min(most_lamps, lamps_.size()); ++i) {
    const raycast::Box box = objects_.object(lamps_[i]).bounds();
    look({box.centre().x, box.centre().y, box.lo.z - off});
    look({box.centre().x, box.centre().y, box.hi.z + off});
  }
  for (std::size_t i = 0; i < points_.size() && most_of_rooms < enough; ++i) { look(points_[i].position + off * points_[i].normal); }
  if (views.empty()) { views.swap(close); }
  double most = 0.0;
  for (const Candidate& candidate : views) { most = std::max(most, candidate.view.lit); }
  std::erase_if(views, [&](const Candidate& candidate) { return candidate.view.lit < as_bright * most; });
  double closed = 0.0;
  for (const Candidate& candidate : views) { closed = std::max(closed, candidate.met); }
  const Candidate* best = nullptr;
  for (const Candidate& candidate : views) {
    if (candidate.met >= as_closed * closed && (best == nullptr || candidate.view.reach > best->view.reach)) { best = &candidate; }
  }
  return best != nullptr && most > 0.0 ? std::optional{best->view} : std::nullopt;
}

}  // namespace apps
