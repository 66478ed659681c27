// SPDX-License-Identifier: MIT
#include <radiosity/intake/shells.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>

namespace radiosity::intake {

HALFLIGHT_INLINE Shells::Shells(Working& mesh, const Topology& topology, std::span<const Material> materials, const IntakeOptions& options)
    : mesh_(mesh), materials_(materials), options_(options) {
  components_.resize(topology.components);
  for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
    Component& component = components_[topology.component[f]];
    component.faces.push_back(f);
    component.several = component.several || mesh_.faces[f].group != mesh_.faces[component.faces[0]].group;
    for (const std::uint32_t v : mesh_.faces[f].corners) { component.box.extend(mesh_.positions[v]); }
    for (std::uint32_t s = topology.first[f]; s < topology.first[f + 1]; ++s) {
      component.closed = component.closed && topology.mate[s] != none;
    }
  }
  for (Component& component : components_) {
    bounds_.extend(component.box.lo);
    bounds_.extend(component.box.hi);
    if (!component.closed) { continue; }
    for (const std::uint32_t f : component.faces) {
      const std::span<const glm::dvec3> p = mesh_.outline(mesh_.faces[f]);
      component.volume += glm::dot(p[0] - component.box.centre(), brep::vector_area(p)) / 3.0;
    }
    const double size = component.box.diameter();
    component.role = std::abs(component.volume) > 1e-9 * size * size * size ? Role::solid : Role::surface;
  }
}

HALFLIGHT_INLINE bool Shells::holds(const Component& shell, const glm::dvec3& point) const {
  const auto beyond = [&](int k) { return point[k] < shell.box.lo[k] || point[k] > shell.box.hi[k]; };
  if (beyond(0) || beyond(1) || beyond(2)) { return false; }
  double angle = 0.0;
  for (const std::uint32_t f : shell.faces) {
    const std::span<const glm::dvec3> p = mesh_.outline(mesh_.faces[f]);
    for (std::size_t i = 2; i < p.size(); ++i) {
      const glm::dvec3 a = p[0] - point, b = p[i - 1] - point, c = p[i] - point;
      const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
      const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
      angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), below);
    }
  }
  return std::abs(angle) > 2.0 * std::numbers::pi;
}

HALFLIGHT_INLINE std::vector<Shells::Twins> Shells::find_twins() {
  std::vector<Component*> order;
  for (Component& component : components_) {
    if (component.role == Role::solid) { order.push_back(&component); }
  }
  const auto left_end = [](const Component* c) { return c->box.lo.x; };
  std::sort(order.begin(), order.end(), [&](const Component* a, const Component* b) { return left_end(a) < left_end(b); });
  const auto same = [&](const Component& a, const Component& b) {
    return a.box.grown(mesh_.tolerance).contains(b.box.lo) && a.box.grown(mesh_.tolerance).contains(b.box.hi) &&
           b.box.grown(mesh_.tolerance).contains(a.box.lo) && b.box.grown(mesh_.tolerance).contains(a.box.hi) &&
           std::abs(a.volume + b.volume) < 1e-6 * std::abs(a.volume);
  };
  constexpr std::size_t most_asked = 64;
  std::vector<Twins> twins;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = i + 1; k < std::min(order.size(), i + most_asked) && left_end(order[k]) <= left_end(order[i]) + mesh_.tolerance;
         ++k) {
      if (!same(*order[i], *order[k])) { continue; }
      twins.push_back(order[i]->volume > 0.0 ? Twins{order[i], order[k]} : Twins{order[k], order[i]});
    }
  }
  return twins;
}

HALFLIGHT_INLINE void Shells::settle(const Twins& twins) {
  if (twins.inner->role == Role::surface) { return; }
  const bool room = twins.inner->role == Role::room || twins.inner->role == Role::cavity;
  Component& gone = room ? *twins.outer : *twins.inner;
  if (!room) { twins.outer->role = Role::solid; }
  gone.role = Role::nothing;
  for (const std::uint32_t f : gone.faces) {
    mesh_.changed(ChangeKind::duplicate, mesh_.faces[f].polygon);
    for (const Source& source : mesh_.faces[f].more) { mesh_.changed(ChangeKind::duplicate, source.polygon); }
  }
}

HALFLIGHT_INLINE Component* Shells::innermost(std::span<const Place> places, const Component* but) {
  Component* best = nullptr;
  for (Component& shell : components_) {
    if (shell.role == Role::surface || shell.role == Role::nothing || &shell == but ||
        (best != nullptr && std::abs(shell.volume) >= std::abs(best->volume))) {
      continue;
    }
    const bool either = shell.volume < 0.0 || (but != nullptr && but->closed);
    const auto held = [&](const Place& place) { return holds(shell, place.front) || (either && holds(shell, place.behind)); };
    if (std::all_of(places.begin(), places.end(), held)) { best = &shell; }
  }
  return best;
}

HALFLIGHT_INLINE Component* Shells::shell_around_others() {
  constexpr std::size_t most_asked = 1000;
  for (Component& shell : components_) {
    const raycast::Box box = shell.box.grown(mesh_.tolerance);
    if (shell.role != Role::solid || shell.volume > 0.0 || !box.contains(bounds_.lo) || !box.contains(bounds_.hi)) { continue; }
    const std::span<const Component> asked = std::span<const Component>(components_).first(std::min(components_.size(), most_asked));
    const bool walls = has_walls(shell);
    const bool others = std::any_of(asked.begin(), asked.end(), [&](const Component& other) {
      return &other != &shell && (walls ? other.volume >= 0.0 : other.volume > 0.0) && holds(shell, other.box.centre());
    });
    const auto inwards = std::count_if(asked.begin(), asked.end(), [&](const Component& o) { return &o != &shell && o.volume < 0.0; });
    const auto outwards = std::count_if(asked.begin(), asked.end(), [&](const Component& o) { return o.volume > 0.0; });
    if (others && 2 * inwards <= outwards) { return &shell; }
  }
  return nullptr;
}

HALFLIGHT_INLINE std::uint32_t Shells::around(const Component& shell) const {
  std::uint32_t best = none;
  for (std::uint32_t c = 0; c < components_.size(); ++c) {
    const Component& other = components_[c];
    if (&other == &shell || other.role == Role::surface || other.role == Role::nothing) { continue; }
    const double volume = std::abs(other.volume);
    if (!(volume > std::abs(shell.volume)) || (best != none && volume >= std::abs(components_[best].volume))) { continue; }
    const raycast::Box box = other.box.grown(mesh_.tolerance);
    if (box.contains(shell.box.lo) && box.contains(shell.box.hi) && holds(other, shell.box.centre())) { best = c; }
  }
  return best;
}

HALFLIGHT_INLINE void Shells::find_nests() {
  constexpr std::size_t most_asked = 1000;
  if (components_.size() > most_asked) { return; }
  nests_.resize(components_.size());
  for (std::uint32_t c = 0; c < components_.size(); ++c) {
    if (components_[c].role != Role::solid && components_[c].role != Role::room) { continue; }
    const std::uint32_t outer = around(components_[c]);
    if (outer == none) { continue; }
    nests_[outer].inner.push_back(c);
    nests_[outer].filled += std::abs(components_[c].volume / components_[outer].volume);
  }
}

HALFLIGHT_INLINE void Shells::find_nested_rooms(bool room_known) {
  const std::vector<Nest>& nests = nests_;
  if (nests.empty()) { return; }
  for (std::uint32_t c = 0; c < components_.size(); ++c) {
    Component& outer = components_[c];
    const auto opposite = [&](std::uint32_t i) { return (components_[i].volume > 0.0) != (outer.volume > 0.0); };
    const std::vector<std::uint32_t>& inner = nests[c].inner;
    if (outer.role != Role::solid || inner.empty()) { continue; }
    if (nests[c].filled >= 0.5) {
      for (const std::uint32_t i : inner) {
        const bool room = opposite(i) || !nests[i].inner.empty();
        if (room && components_[i].role == Role::solid && !shines(components_[i])) { components_[i].role = Role::room; }
      }
    } else if (!room_known && outer.volume > 0.0 && std::all_of(inner.begin(), inner.end(), opposite)) {
      outer.role = Role::room;
    }
  }
}

HALFLIGHT_INLINE void Shells::turn_shells() {
  for (Component& component : components_) {
    if (component.role == Role::nothing) { continue; }
    const bool inwards = component.volume < 0.0;
    if (component.role == Role::surface || (component.role == Role::room) == inwards) { continue; }
    std::uint32_t first = none;
    for (const std::uint32_t f : component.faces) { first = std::min(first, mesh_.faces[f].polygon); }
    mesh_.changed(inwards ? ChangeKind::inside_out : ChangeKind::room, first);
    component.volume = -component.volume;
    turned_.resize(components_.size());
    turned_[static_cast<std::size_t>(&component - components_.data())] = true;
  }
}

HALFLIGHT_INLINE void Shells::hollow_solids() {
  for (Component& component : components_) {
    if (component.role != Role::room) { continue; }
    const glm::dvec3& corner = mesh_.outline(mesh_.faces[component.faces[0]])[0];
    const Place place{corner, corner};
    Component* const around = innermost(std::span(&place, 1), &component);
    const bool within_walls = around != nullptr && around->role == Role::solid && around->volume >= -component.volume;
    rooms_.push_back({component.box, within_walls});
    if (!within_walls) { continue; }
    component.role = Role::cavity;
    around->cavities.push_back(static_cast<std::uint32_t>(&component - components_.data()));
  }
}

HALFLIGHT_INLINE void Shells::part_groups() {
  const auto part = [](Component& component) {
    component.role = Role::surface;
    component.one_sided = true;
  };
  for (Component& component : components_) {
    const bool any = std::any_of(component.cavities.begin(), component.cavities.end(), [&](auto c) { return components_[c].several; });
    if (component.role == Role::surface || component.role == Role::nothing || !(component.several || any)) { continue; }
    if (component.role == Role::cavity) { continue; }  // handled with the solid around it
    if (component.role == Role::solid && component.cavities.empty()) { continue; }
    part(component);
    for (const std::uint32_t cavity : component.cavities) { part(components_[cavity]); }
    component.cavities.clear();
  }
}

HALFLIGHT_INLINE void Shells::lay(std::uint32_t component, bool turn, bool one_sided) {
  components_[component].flush = true;
  components_[component].one_sided = one_sided;
  turned_.resize(components_.size());
  turned_[component] = turn;
}

HALFLIGHT_INLINE void Shells::turn(std::uint32_t component) {
  turned_.resize(components_.size());
  turned_[component] = true;
}

HALFLIGHT_INLINE void Shells::show_one_side(std::uint32_t component, bool back) {
  components_[component].one_sided = true;
  turned_.resize(components_.size());
  turned_[component] = back;
}

HALFLIGHT_INLINE void Shells::find_roles() {
  const std::vector<Twins> twins = find_twins();
  for (const Twins& t : twins) { t.outer->role = Role::surface; }
  find_nests();
  bool room_known = false;
  for (Component* const room : find_rooms()) {
    if (room == nullptr) { continue; }
    room->role = Role::room;
    room_known = true;
  }
  find_nested_rooms(room_known);
  room_known = std::any_of(components_.begin(), components_.end(), [](const Component& c) { return c.role == Role::room; });
  if (Component* const around = room_known ? nullptr : shell_around_others()) { around->role = Role::room; }
  for (const Twins& t : twins) {
    if (t.inner->role != Role::room) { settle(t); }
  }
  turn_shells();
  hollow_solids();
  part_groups();
  for (Component& component : components_) {  // everything beyond the walls of a room would count as buried
    if (component.role != Role::room) { continue; }
    const raycast::Box box = component.box.grown(mesh_.tolerance);
    const bool all = glm::min(box.lo, bounds_.lo) == box.lo && glm::max(box.hi, bounds_.hi) == box.hi;
    if (!all) { component.role = Role::surface; }
  }
  for (const Twins& t : twins) {
    if (t.inner->role != Role::nothing) { settle(t); }
  }
}

}  // namespace radiosity::intake
