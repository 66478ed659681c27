// SPDX-License-Identifier: MIT
#include <radiosity/intake/objects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>

namespace radiosity::intake {
namespace detail {

enum class Role : unsigned char { surface, solid, room, cavity, nothing };

struct Component {
  std::vector<std::uint32_t> faces;
  raycast::Box box;
  bool closed = true;
  double volume = 0.0;  // of a closed one; negative when it looks inwards
  Role role = Role::surface;
  std::vector<std::uint32_t> cavities;  // of a solid: faces of the rooms in it
};

class ObjectMaker {
 public:
  ObjectMaker(Working& mesh, const Topology& topology, const PolygonView& input, std::span<const Material> materials,
              const IntakeOptions& options)
      : mesh_(mesh), topology_(topology), input_(input), materials_(materials), options_(options) {
    local_.assign(topology.vertices, none);
    find_components();
  }

  MadeObjects run() {
    find_roles();
    struct Group {
      std::vector<const Component*> closed;
      std::vector<std::uint32_t> front, back;
    };
    std::vector<Group> groups(std::max<std::size_t>(input_.names.size(), 1));
    for (const Component& component : components_) {
      if (component.role == Role::cavity || component.role == Role::nothing) { continue; }
      const std::uint32_t g = mesh_.faces[component.faces[0]].group;
      if (g >= groups.size()) { groups.resize(g + 1); }
      if (component.role != Role::surface) {
        groups[g].closed.push_back(&component);
        continue;
      }
      bool mixed = false;
      for (const std::uint32_t f : component.faces) {
        groups[g].front.push_back(f);
        if (has_back(mesh_.faces[f])) { groups[g].back.push_back(f); }
        if (mesh_.faces[f].mixed) { mesh_.changed(ChangeKind::both_sides, mesh_.faces[f].polygon, 0.0, mixed ? 0 : 1); }
        mixed = mixed || mesh_.faces[f].mixed;
      }
    }
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
      const std::size_t first = objects_.size();
      for (const Component* const component : groups[g].closed) {
        std::vector<std::uint32_t> faces = component->faces;
        faces.insert(faces.end(), component->cavities.begin(), component->cavities.end());
        add(faces, component->role, false);
      }
      add_surface(groups[g].front, false);
      add_surface(groups[g].back, true);
      const std::string name = g < input_.names.size() ? input_.names[g] : std::string("mesh");
      for (std::size_t i = first; i < objects_.size(); ++i) {
        objects_[i].name = objects_.size() == first + 1 ? name : name + "." + std::to_string(i - first + 1);
      }
    }
    return {std::move(objects_), std::move(sheets_)};
  }

 private:
  void find_components() {
    components_.resize(topology_.components);
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      Component& component = components_[topology_.component[f]];
      component.faces.push_back(f);
      for (const std::uint32_t v : mesh_.faces[f].corners) { component.box.extend(mesh_.positions[v]); }
      for (std::uint32_t s = topology_.first[f]; s < topology_.first[f + 1]; ++s) {
        component.closed = component.closed && topology_.mate[s] != none;
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

  // The part of all directions from the point in which the shell is seen from behind: 1 inside, 0 outside (van Oosterom, Strackee 1983).
  [[nodiscard]] bool holds(const Component& shell, const glm::dvec3& point) {
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

  // Shells of the same place, of which one looks outwards and one inwards: walls that were given twice, for both sides.
  struct Twins {
    Component *outer = nullptr, *inner = nullptr;
  };
  [[nodiscard]] std::vector<Twins> find_twins() {
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
      for (std::size_t k = i + 1; k < std::min(order.size(), i + most_asked) && left_end(order[k]) <= left_end(order[i]) + mesh_.tolerance; ++k) {
        if (!same(*order[i], *order[k])) { continue; }
        twins.push_back(order[i]->volume > 0.0 ? Twins{order[i], order[k]} : Twins{order[k], order[i]});
      }
    }
    return twins;
  }

  // One side of the walls is seen; the other stays where it is neither clear that all lies within, nor that nothing does.
  void settle(const Twins& twins) {
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

  // A point that must be seen, on either side of a lamp that may lie on a wall.
  struct Place {
    glm::dvec3 front{0.0}, behind{0.0};
  };

  // The innermost shell that holds all these points. What lies on a shell is in it when its front is; or, of a shell that looks inwards,
  // when its back is.
  [[nodiscard]] Component* innermost(std::span<const Place> places, const Component* but) {
    Component* best = nullptr;
    for (Component& shell : components_) {
      if (shell.role == Role::surface || &shell == but || (best != nullptr && std::abs(shell.volume) >= std::abs(best->volume))) {
        continue;
      }
      const auto held = [&](const Place& place) { return holds(shell, place.front) || (shell.volume < 0.0 && holds(shell, place.behind)); };
      if (std::all_of(places.begin(), places.end(), held)) { best = &shell; }
    }
    return best;
  }

  // The shell that looks inwards at all the others, which do not look inwards themselves, as in a model that is inside out. Null: none.
  [[nodiscard]] Component* shell_around_others() {
    constexpr std::size_t most_asked = 1000;
    for (Component& shell : components_) {
      const raycast::Box box = shell.box.grown(mesh_.tolerance);
      if (shell.role != Role::solid || shell.volume > 0.0 || !box.contains(bounds_.lo) || !box.contains(bounds_.hi)) { continue; }
      const std::span<const Component> asked = std::span<const Component>(components_).first(std::min(components_.size(), most_asked));
      const bool others = std::any_of(asked.begin(), asked.end(), [&](const Component& other) {
        return &other != &shell && other.volume >= 0.0 && holds(shell, other.box.centre());
      });
      const bool inside_out = std::any_of(asked.begin(), asked.end(), [&](const Component& o) { return &o != &shell && o.volume < 0.0; });
      if (others && !inside_out) { return &shell; }
    }
    return nullptr;
  }

  void find_roles() {
    constexpr std::size_t most_lamps = 64, most_points = 16;
    const std::vector<Twins> twins = find_twins();
    for (const Twins& t : twins) { t.outer->role = Role::surface; }
    std::vector<Component*> rooms;
    std::size_t lamps = 0;
    for (Component& component : components_) {
      std::vector<Place> places;
      for (const std::uint32_t f : component.faces) {
        if (places.size() >= most_points || is_black(materials_[mesh_.faces[f].material].emission)) { continue; }
        const std::span<const glm::dvec3> outline = mesh_.outline(mesh_.faces[f]);
        const glm::dvec3 middle = brep::centroid(outline), off = 4.0 * mesh_.tolerance * glm::normalize(brep::vector_area(outline));
        places.push_back({middle + off, middle - off});
      }
      if (places.empty() || ++lamps > most_lamps) { continue; }
      rooms.push_back(innermost(places, &component));
      if (component.volume < 0.0 && component.role == Role::solid) { rooms.push_back(&component); }  // it shines inwards
    }
    if (Component* const around = shell_around_others()) { rooms.push_back(around); }
    for (const glm::dvec3& eye : options_.eyes) {
      const Place place{eye, eye};
      rooms.push_back(innermost(std::span(&place, 1), nullptr));
    }
    for (Component* const room : rooms) {
      if (room != nullptr) { room->role = Role::room; }
    }
    for (const Twins& t : twins) {
      if (t.inner->role != Role::room) { settle(t); }
    }
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
    for (Component& component : components_) {  // walls with a thickness: the room is a cavity of the solid around it
      if (component.role != Role::room) { continue; }
      const glm::dvec3& corner = mesh_.outline(mesh_.faces[component.faces[0]])[0];
      const Place place{corner, corner};
      Component* const around = innermost(std::span(&place, 1), &component);
      if (around == nullptr || around->role != Role::solid || around->volume < -component.volume) { continue; }
      component.role = Role::cavity;
      around->cavities.insert(around->cavities.end(), component.faces.begin(), component.faces.end());
    }
    for (Component& component : components_) {  // what is beyond the walls of a room would be buried
      if (component.role != Role::room) { continue; }
      const raycast::Box box = component.box.grown(mesh_.tolerance);
      const bool all = glm::min(box.lo, bounds_.lo) == box.lo && glm::max(box.hi, bounds_.hi) == box.hi;
      if (!all) { component.role = Role::surface; }
    }
    for (const Twins& t : twins) {
      if (t.inner->role != Role::nothing) { settle(t); }
    }
  }

  [[nodiscard]] bool is_turned(std::uint32_t face) const { return !turned_.empty() && turned_[topology_.component[face]]; }

  [[nodiscard]] bool has_back(const Face& face) const {
    return options_.two_sided || face.mixed || (face.material < input_.two_sided.size() && input_.two_sided[face.material] != 0);
  }

  // A surface without a border would be a solid: one of its faces becomes an object of its own.
  void add_surface(std::vector<std::uint32_t> faces, bool back) {
    const auto on_border = [&](std::uint32_t f) {
      for (std::uint32_t s = topology_.first[f]; s < topology_.first[f + 1]; ++s) {
        if (topology_.mate[s] == none) { return true; }
      }
      return false;
    };
    if (faces.size() > 1 && std::none_of(faces.begin(), faces.end(), on_border)) {
      add({faces.back()}, Role::surface, back);
      faces.pop_back();
    }
    if (!faces.empty()) { add(faces, Role::surface, back); }
  }

  // The normals of a room are those of the solid that it is the inside of, so its faces are turned as those of a back are.
  void add(const std::vector<std::uint32_t>& faces, Role role, bool back) {
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> corners;
    std::vector<std::uint32_t> material, used;
    for (const std::uint32_t f : faces) {
      corners.emplace_back();
      material.push_back(mesh_.faces[f].material);
      for (std::uint32_t s = topology_.first[f]; s < topology_.first[f + 1]; ++s) {
        const std::uint32_t v = topology_.vertex[s];
        if (local_[v] == none) {
          local_[v] = static_cast<std::uint32_t>(positions.size());
          used.push_back(v);
          positions.push_back(mesh_.positions[mesh_.faces[f].corners[s - topology_.first[f]]]);
        }
        corners.back().push_back(local_[v]);
      }
      if ((role == Role::room) != (back != is_turned(f))) { std::reverse(corners.back().begin(), corners.back().end()); }
    }
    for (const std::uint32_t v : used) { local_[v] = none; }
    raycast::Placement placement;
    placement.inside = role == Role::room;
    if (raycast::Made<raycast::Mesh> made = raycast::Mesh::make(positions, corners)) {
      for (std::uint32_t sheet = 0; sheet < faces.size(); ++sheet) { came_from(faces[sheet], sheet, back); }
      if (std::all_of(material.begin(), material.end(), [&](auto m) { return m == material[0]; })) { material.resize(1); }
      objects_.push_back({{}, std::move(made.object), placement, std::move(material)});
      return;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {  // no surface after all: polygons
      std::vector<glm::dvec3> outline;
      for (const std::uint32_t v : corners[i]) { outline.push_back(positions[v]); }
      if (placement.inside) { std::reverse(outline.begin(), outline.end()); }
      raycast::Made<raycast::Polygon> made = raycast::Polygon::make(std::move(outline));
      const std::uint32_t polygon = mesh_.faces[faces[i]].polygon;
      mesh_.changed(made ? ChangeKind::loose : ChangeKind::unusable, polygon);
      if (!made) { continue; }
      came_from(faces[i], 0, back);
      objects_.push_back({{}, std::move(made.object), {}, {material[i]}});
    }
  }

  // Of the object that is added next.
  void came_from(std::uint32_t face, std::uint32_t sheet, bool back) {
    sheets_.push_back({{static_cast<std::uint32_t>(objects_.size()), sheet, back != is_turned(face)}, face});
  }

  Working& mesh_;
  const Topology& topology_;
  const PolygonView& input_;
  std::span<const Material> materials_;
  const IntakeOptions& options_;
  std::vector<Component> components_;
  std::vector<bool> turned_;  // of a component
  raycast::Box bounds_;
  std::vector<std::uint32_t> local_;  // of a vertex, in the object that is made
  std::vector<SceneObject> objects_;
  std::vector<SheetOrigin> sheets_;
};

}  // namespace detail

HALFLIGHT_INLINE MadeObjects make_objects(Working& mesh, const Topology& topology, const PolygonView& input,
                                          std::span<const Material> materials, const IntakeOptions& options) {
  return detail::ObjectMaker(mesh, topology, input, materials, options).run();
}

HALFLIGHT_INLINE PolygonParts parts_of(const Working& mesh, std::span<const SheetOrigin> sheets, std::size_t polygons) {
  std::vector<std::pair<std::uint32_t, PolygonPart>> list;  // polygon and part
  for (const SheetOrigin& sheet : sheets) {
    const Face& face = mesh.faces[sheet.face];
    const auto add = [&](const Source& source) {
      list.push_back({source.polygon, sheet.part});
      list.back().second.back = sheet.part.back != source.turned;
    };
    add({face.polygon, face.turned});
    for (const Source& source : face.more) { add(source); }
  }
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  PolygonParts result;
  result.first.assign(polygons + 1, 0);
  for (const auto& [polygon, part] : list) {
    ++result.first[polygon + 1];
    result.all.push_back(part);
  }
  for (std::size_t p = 0; p < polygons; ++p) { result.first[p + 1] += result.first[p]; }
  return result;
}

}  // namespace radiosity::intake
