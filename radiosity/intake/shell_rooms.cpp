// SPDX-License-Identifier: MIT
// Decides which shells are rooms, from the lamps and eyes in them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>

#include <radiosity/intake/shells.hpp>

namespace radiosity::intake {

HALFLIGHT_INLINE bool Shells::shines(const Component& shell) const {
  return std::any_of(shell.faces.begin(), shell.faces.end(),
                     [&](std::uint32_t f) { return !is_black(materials_[mesh_.faces[f].material].emission); });
}

HALFLIGHT_INLINE double Shells::shining_share(const Component& shell) const {
  double whole = 0.0, bright = 0.0;
  for (const std::uint32_t f : shell.faces) {
    const double area = brep::area(mesh_.outline(mesh_.faces[f]));
    whole += area;
    bright += is_black(materials_[mesh_.faces[f].material].emission) ? 0.0 : area;
  }
  return whole > 0.0 ? bright / whole : 0.0;
}

HALFLIGHT_INLINE bool Shells::holds_another(const Component& shell, const Component* around) const {
  constexpr std::size_t most_asked = 1000;
  const raycast::Box box = shell.box.grown(mesh_.tolerance);
  const std::span<const Component> asked = std::span<const Component>(components_).first(std::min(components_.size(), most_asked));
  const bool bulb = 2.0 * shining_share(shell) >= 1.0;
  return std::any_of(asked.begin(), asked.end(), [&](const Component& other) {
    const bool whole = box.contains(other.box.lo) && box.contains(other.box.hi);
    const bool shade = bulb && other.box.diameter() >= shell.box.diameter();
    return &other != &shell && (whole || (around == nullptr && !shade)) && holds(shell, other.box.centre());
  });
}

HALFLIGHT_INLINE bool Shells::has_walls(const Component& shell) const {
  constexpr std::size_t most_planes = 6;
  constexpr double tol_parallel = 1e-6;
  struct Wall {
    glm::dvec3 point{0.0}, vector_area{0.0};
    double area = 0.0;
  };
  std::vector<Wall> faces, walls;
  double whole = 0.0, held = 0.0;
  for (const std::uint32_t f : shell.faces) {
    const std::span<const glm::dvec3> outline = mesh_.outline(mesh_.faces[f]);
    const glm::dvec3 across = brep::vector_area(outline);
    faces.push_back({outline[0], across, glm::length(across)});
    whole += faces.back().area;
  }
  std::sort(faces.begin(), faces.end(), [](const Wall& a, const Wall& b) { return a.area > b.area; });
  for (const Wall& face : faces) {
    const auto in_plane_of = [&](const Wall& wall) {
      return glm::dot(face.vector_area, wall.vector_area) >= (1.0 - tol_parallel) * face.area * wall.area &&
             std::abs(glm::dot(face.point - wall.point, wall.vector_area)) <= mesh_.tolerance * wall.area;
    };
    const bool known = std::any_of(walls.begin(), walls.end(), in_plane_of);
    if (!known && walls.size() == most_planes) { continue; }
    if (!known) { walls.push_back(face); }
    held += face.area;
  }
  return held >= 0.4 * whole;
}

HALFLIGHT_INLINE bool Shells::is_furnished(const Component& shell) const {
  constexpr std::size_t most_asked = 1000;
  const raycast::Box box = shell.box.grown(mesh_.tolerance);
  bool furnished = false;
  for (const Component& other : std::span<const Component>(components_).first(std::min(components_.size(), most_asked))) {
    const bool opposite = other.closed && other.volume != 0.0 && (other.volume > 0.0) != (shell.volume > 0.0);
    if (&other == &shell || !opposite || shines(other) || !box.contains(other.box.lo) || !box.contains(other.box.hi)) { continue; }
    if (!holds(shell, other.box.centre())) { continue; }
    if (std::abs(other.volume) > 0.5 * std::abs(shell.volume)) { return false; }
    furnished = true;
  }
  return furnished;
}

HALFLIGHT_INLINE bool Shells::is_bare_room(const Component& shell) const {
  const raycast::Box box = shell.box.grown(mesh_.tolerance);
  const auto within = [&](const Component& other) { return (box.contains(other.box.lo) && box.contains(other.box.hi)) || shines(other); };
  const bool may_be = options_.eyes.empty() && !shines(shell) && (shell.volume < 0.0 || options_.sides_unknown);
  return may_be && has_walls(shell) && std::all_of(components_.begin(), components_.end(), within);
}

HALFLIGHT_INLINE Component* Shells::pierced_by(std::span<const Place> places, const Component* lamp) {
  Component* best = nullptr;
  for (Component& shell : components_) {
    if ((shell.role != Role::solid && shell.role != Role::room) || &shell == lamp) { continue; }
    if (best != nullptr && std::abs(shell.volume) >= std::abs(best->volume)) { continue; }
    const auto held = static_cast<std::size_t>(std::count_if(
        places.begin(), places.end(), [&](const Place& place) { return holds(shell, place.front) || holds(shell, place.behind); }));
    if (held > 0 && held < places.size() && (is_furnished(shell) || is_bare_room(shell))) { best = &shell; }
  }
  return best;
}

HALFLIGHT_INLINE double Shells::way(const Place& place, bool ahead, std::span<const Component* const> but) {
  const glm::dvec3 from = ahead ? place.front : place.behind;
  const glm::dvec3 direction = glm::normalize(ahead ? place.front - place.behind : place.behind - place.front);
  const raycast::RayFrame line({from, direction});
  double nearest = HUGE_VAL;
  for (const Component& component : components_) {
    if (std::find(but.begin(), but.end(), &component) != but.end()) { continue; }
    for (const std::uint32_t f : component.faces) {
      const std::span<const glm::dvec3> outline = mesh_.outline(mesh_.faces[f]);
      if (line.winding(outline) == 0) { continue; }
      const glm::dvec3 across = brep::vector_area(outline);
      const double at = glm::dot(outline[0] - from, across) / glm::dot(direction, across);
      if (at > 0.0) { nearest = std::min(nearest, at); }
    }
  }
  return nearest;
}

HALFLIGHT_INLINE bool Shells::lies_outside(const Component& shell, const Component& lamp, std::span<const Place> places) {
  constexpr std::size_t most_asked = 1000;
  constexpr double thin = 0.5;  // relative to the way on the other side
  if (!(shell.volume > 0.0) || lamp.closed || components_.size() > most_asked) { return false; }
  const auto in_it = [&](const Component& other) { return &other != &shell && !shines(other) && holds(shell, other.box.centre()); };
  const bool on_it = std::none_of(places.begin(), places.end(), [&](const Place& place) { return holds(shell, place.behind); });
  if (!on_it || std::any_of(components_.begin(), components_.end(), in_it)) { return false; }
  const std::array<const Component*, 2> both{&lamp, &shell};
  const double other_way = way(places[0], false, both);
  return other_way < HUGE_VAL && way(places[0], true, std::span(both).first(1)) < thin * other_way;
}

HALFLIGHT_INLINE bool Shells::shines_inwards(const Component& lamp, const Component* around, bool around_is_room) const {
  if (lamp.role != Role::solid) { return false; }
  if (lamp.volume > 0.0) { return 2.0 * shining_share(lamp) < 1.0 && is_furnished(lamp); }
  if (holds_another(lamp, around)) { return true; }
  if (around == nullptr) { return components_.size() == 1; }
  const bool walls = nests_.empty() ? !is_furnished(*around) : nests_[static_cast<std::size_t>(around - components_.data())].filled >= 0.5;
  return around->volume > 0.0 && !around_is_room && walls;
}

HALFLIGHT_INLINE Component* Shells::room_of_thing(const Component& thing) {
  if (thing.role != Role::solid || !(thing.volume > 0.0 || options_.sides_unknown)) { return nullptr; }
  Component* best = nullptr;
  for (Component& shell : components_) {
    if ((shell.role != Role::solid && shell.role != Role::room) || !(std::abs(shell.volume) > std::abs(thing.volume))) { continue; }
    if (best != nullptr && std::abs(shell.volume) >= std::abs(best->volume)) { continue; }
    if (holds(shell, thing.box.centre())) { best = &shell; }
  }
  return best;
}

// By decreasing area, and by place if that is equal: not by the order in the file.
HALFLIGHT_INLINE std::vector<Shells::Lamp> Shells::lamps() {
  constexpr std::size_t most = 64;
  const auto larger = [](const auto& a, const auto& b) {
    return std::tie(b.area, a.middle.x, a.middle.y, a.middle.z) < std::tie(a.area, b.middle.x, b.middle.y, b.middle.z);
  };
  std::vector<Lamp> lamps;
  for (Component& component : components_) {
    Lamp lamp{&component, component.box.centre(), 0.0, {}};
    for (const std::uint32_t f : component.faces) {
      if (is_black(materials_[mesh_.faces[f].material].emission)) { continue; }
      const std::span<const glm::dvec3> outline = mesh_.outline(mesh_.faces[f]);
      lamp.bright.push_back({f, brep::centroid(outline), brep::area(outline)});
      lamp.area += lamp.bright.back().area;
    }
    if (lamp.bright.empty()) { continue; }
    std::sort(lamp.bright.begin(), lamp.bright.end(), larger);
    lamps.push_back(std::move(lamp));
  }
  std::sort(lamps.begin(), lamps.end(), larger);
  lamps.resize(std::min(lamps.size(), most));
  return lamps;
}

HALFLIGHT_INLINE std::vector<Component*> Shells::find_rooms() {
  constexpr std::size_t most_points = 64;  // of a lamp
  std::vector<Component*> rooms;
  for (const glm::dvec3& eye : options_.eyes) {
    const Place place{eye, eye};
    rooms.push_back(innermost(std::span(&place, 1), nullptr));
  }
  const std::vector<Component*> around_eyes = rooms;
  const auto has_eye = [&](const Component* shell) {
    return shell != nullptr && std::find(around_eyes.begin(), around_eyes.end(), shell) != around_eyes.end();
  };
  for (const auto& lamp : options_.lamps) {
    std::vector<Place> places;
    for (const glm::dvec3& p : lamp) { places.push_back({p, p}); }
    Component* const around = innermost(places, nullptr);
    Component* const outer = around != nullptr && !has_eye(around) ? room_of_thing(*around) : nullptr;
    rooms.push_back(has_eye(outer) ? outer : around != nullptr ? around : pierced_by(places, nullptr));
  }
  const std::vector<Component*> known = rooms;
  const auto seen_from_inside = [&](const Component* shell) {
    return shell != nullptr && std::find(known.begin(), known.end(), shell) != known.end();
  };
  for (const Lamp& lamp : lamps()) {
    const Component& component = *lamp.component;
    std::vector<Place> places, corners;
    for (std::size_t i = 0; i < std::min(most_points, lamp.bright.size()); ++i) {
      const std::uint32_t f = lamp.bright[i * lamp.bright.size() / std::min(most_points, lamp.bright.size())].face;
      const std::span<const glm::dvec3> outline = mesh_.outline(mesh_.faces[f]);
      const glm::dvec3 middle = brep::centroid(outline), off = 4.0 * mesh_.tolerance * glm::normalize(brep::vector_area(outline));
      places.push_back({middle + off, middle - off});
      for (const glm::dvec3& p : outline) { corners.push_back({glm::mix(p, middle, 0.01) + off, glm::mix(p, middle, 0.01) - off}); }
    }
    Component* around = innermost(places, &component);
    if (around != nullptr && !seen_from_inside(around) && lies_outside(*around, component, places)) {
      for (Place& place : places) { std::swap(place.front, place.behind); }
      for (Place& corner : corners) { std::swap(corner.front, corner.behind); }
      around = innermost(places, &component);
    }
    if (around != nullptr && around->volume > 0.0 && !is_furnished(*around)) {
      // An object through which a lamp sticks out is furniture if a furnished shell contains the whole lamp.
      Component* const whole = innermost(corners, &component);
      if (whole != nullptr && is_furnished(*whole)) { around = whole; }
    }
    Component* const pierced = pierced_by(places, &component);
    if (pierced != nullptr && (around == nullptr || std::abs(pierced->volume) < std::abs(around->volume))) { around = pierced; }
    const bool itself = shines_inwards(component, around, seen_from_inside(around));
    if (around != nullptr && !itself && !seen_from_inside(around)) {
      Component* const outer = room_of_thing(*around);
      if (outer != nullptr && (seen_from_inside(outer) || (shines(*around) && options_.eyes.empty()))) { around = outer; }
    }
    rooms.push_back(itself ? lamp.component : around);
  }
  return rooms;
}

}  // namespace radiosity::intake
