// SPDX-License-Identifier: MIT
#include "apps/intake/open_rooms.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/vector_relational.hpp>

#include <raycast/ray.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/scene/bounds.hpp>

namespace apps {
namespace {

constexpr double most_open = 0.1;  // a doorway covers a few hundredths of what is seen, a wall or a ceiling that is not there a sixth
constexpr double open_beside_door = 0.25;

// The fronts that a picture shows: a coarse one, but for meshes of faces so small that more rays show more of them.
OpenRooms::Surfaces shown_by(const raycast::Scene& objects, const radiosity::Camera& camera) {
  constexpr std::uint32_t coarse = 24, fine = 96;
  for (std::uint32_t across = coarse;; across *= 2) {
    const radiosity::View view = radiosity::make_view(camera, {across, across * 3 / 4});
    OpenRooms::Surfaces shown;
    std::size_t hits = 0;
    for (std::uint32_t i = 0; i < view.size.width * view.size.height; ++i) {
      raycast::Segment ray{view.eye, view.direction(i % view.size.width + 0.5, i / view.size.width + 0.5)};
      const auto hit = radiosity::seen_front(objects, ray);
      if (!hit) { continue; }
      shown.emplace(hit->object, hit->sheet);
      ++hits;
    }
    if (across >= fine || 2 * shown.size() < hits) { return shown; }
  }
}

}  // namespace

OpenRooms::OpenRooms(const radiosity::Scene& scene) : scene_(scene), objects_(radiosity::placed_objects(scene)) {}

bool OpenRooms::is_skin(const glm::dvec3& at, const glm::dvec3& direction) const {
  const double thin = 1e-6 * objects_.diameter();
  const glm::dvec3 outside = at + thin * direction;
  const auto next = objects_.closest({outside, direction});
  return !next || (next->front && !objects_.closest({outside + (next->t + thin) * direction, direction}));
}

OpenRooms::Around OpenRooms::look_around(const glm::dvec3& eye) const {
  constexpr int directions = 512;
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));  // directions of a spiral (Vogel 1979) cover the sphere evenly
  constexpr double overhead = 0.7;                                        // within 45 degrees of straight up
  struct Back {
    std::uint32_t object, sheet;
    double z;  // of the direction
  };
  Around around;
  std::map<std::uint32_t, int> skins;  // by object: directions in which its skin is met
  std::vector<Back> backs;
  for (int i = 0; i < directions; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / directions, aside = std::sqrt(1.0 - z * z), angle = golden_angle * i;
    const glm::dvec3 direction{aside * std::cos(angle), aside * std::sin(angle), z};
    const auto hit = objects_.closest({eye, direction});
    if (!hit) {
      around.open += 1.0 / directions;
      continue;
    }
    around.bounds.extend(eye + hit->t * direction);
    around.surfaces.emplace(hit->object, hit->sheet);
    if (is_skin(eye + hit->t * direction, direction)) { ++skins[hit->object]; }
    if (hit->front) {
      around.shown += 1.0 / directions;
    } else if (z > 0.0 && !objects_.object(hit->object).solid()) {
      backs.push_back({hit->object, hit->sheet, z});
    }
  }
  for (const auto& [object, count] : skins) { around.skin = std::max(around.skin, 1.0 * count / directions); }
  std::set<std::uint32_t> roofs;
  for (const Back& back : backs) {
    if (back.z > overhead) { roofs.insert(back.object); }
  }
  for (const Back& back : backs) {
    if (!roofs.contains(back.object)) { continue; }
    around.shown += 1.0 / directions;
    around.roof.emplace(back.object, back.sheet);
  }
  return around;
}

bool OpenRooms::is_room(const Around& here) const {
  return here.open <= most_open || (here.open <= open_beside_door && look_around(here.bounds.centre()).open <= most_open);
}

OpenRooms::Surfaces OpenRooms::roof_over(const glm::dvec3& eye) const {
  Around here = look_around(eye);
  return is_room(here) ? std::move(here.roof) : Surfaces();
}

std::optional<raycast::Box> OpenRooms::around(const glm::dvec3& eye) const {
  const Around here = look_around(eye);
  return is_room(here) ? std::optional(here.bounds) : std::nullopt;
}

std::optional<OpenRooms::Hidden> OpenRooms::hidden() const {
  constexpr std::size_t times = 3;
  constexpr double most_backs = 0.02, most_skin = 0.9;
  constexpr double least_height = 0.2;  // of the ceiling above the eye, of the model's height: not the next floor of a house, or a shelf
  std::size_t outside = 0;
  for (const radiosity::Camera& camera : radiosity::outside_cameras(scene_)) {
    outside = std::max(outside, shown_by(objects_, camera).size());
  }
  const raycast::Box bounds = radiosity::bounds_without_strays(scene_);
  std::optional<Hidden> room;
  std::size_t most = times * outside;
  constexpr int across = 7;
  for (int i = 0; i < across * across; ++i) {
    const glm::dvec3 eye = bounds.lo + glm::dvec3((i % across + 0.5) / across, (i / across + 0.5) / across, 0.6) * bounds.size();
    const auto ceiling = objects_.closest({eye, {0, 0, 1}}), floor = objects_.closest({eye, {0, 0, -1}});
    if (!ceiling || ceiling->t < least_height * bounds.size().z || !floor) { continue; }
    const Around inside = look_around(eye);
    if (inside.open > most_open || 1.0 - inside.open - inside.shown > most_backs || inside.surfaces.size() < most) { continue; }
    if (inside.skin > most_skin) { continue; }
    most = inside.surfaces.size() + 1;
    room = {eye, inside.bounds};
  }
  return room;
}

std::vector<raycast::Box> OpenRooms::seen_through() const {
  const radiosity::View view = radiosity::make_view(radiosity::automatic_camera(scene_), {24, 18});
  std::size_t fronts = 0, through = 0;
  for (std::uint32_t i = 0; i < view.size.width * view.size.height; ++i) {
    raycast::Segment ray{view.eye, view.direction(i % view.size.width + 0.5, i / view.size.width + 0.5)};
    if (!radiosity::seen_front(objects_, ray)) { continue; }
    (ray.origin == view.eye ? fronts : through) += 1;
  }
  std::vector<raycast::Box> rooms;
  if (through <= fronts) { return rooms; }
  const raycast::Box bounds = radiosity::bounds_without_strays(scene_);
  constexpr int across = 5;
  constexpr double least_share = 0.25;   // of the model's extents: not the gap above a cupboard
  constexpr double most_exposed = 0.15;  // of the places: light comes in through an open side, where half of them are exposed
  int in_air = 0, exposed = 0;
  for (int i = 0; i < across * across * across; ++i) {
    const glm::dvec3 share{(i % across + 0.5) / across, (i / across % across + 0.5) / across, (i / across / across + 0.5) / across};
    const glm::dvec3 eye = bounds.lo + share * bounds.size();
    const Around here = look_around(eye);
    if (here.shown < 1.0 - most_open - here.open) { continue; }
    ++in_air;
    exposed += here.open > most_open ? 1 : 0;
    const bool known = std::ranges::any_of(rooms, [&](const raycast::Box& room) { return room.contains(eye); });
    const bool small = glm::any(glm::lessThan(here.bounds.size(), least_share * bounds.size()));
    if (!known && !small && is_room(here)) { rooms.push_back(here.bounds); }
  }
  if (exposed > most_exposed * in_air) { rooms.clear(); }
  return rooms;
}

}  // namespace apps
