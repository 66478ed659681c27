// SPDX-License-Identifier: MIT
#include <radiosity/intake/decals.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/planar.hpp>

#include <radiosity/intake/beside.hpp>

namespace radiosity::intake {

namespace detail {

// By component: its area, and whether it may be a decal.
struct FlatComponent {
  double area = 0.0;
  bool flat = true, open = false, emits = false;
  glm::dvec3 normal{0.0}, point{0.0};
};

[[nodiscard]] HALFLIGHT_INLINE std::vector<FlatComponent> flat_components(Working& mesh, const Topology& topology,
                                                                          std::span<const Material> materials) {
  std::vector<FlatComponent> result(topology.components);
  const auto emits = [&](std::uint32_t m) { return m != none && !is_black(materials[m].emission); };
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    FlatComponent& own = result[topology.component[f]];
    own.emits = own.emits || emits(face.material) || emits(face.back);
    for (std::uint32_t s = topology.first[f]; s < topology.first[f + 1]; ++s) { own.open = own.open || topology.mate[s] == none; }
    const raycast::Plane plane = raycast::plane_of(mesh.outline(face));
    if (own.area == 0.0) { own.normal = plane.normal, own.point = plane.point; }
    own.area += brep::area(mesh.outline(face));
    own.flat =
        own.flat && glm::dot(plane.normal, own.normal) > 0.0 && std::all_of(face.corners.begin(), face.corners.end(), [&](std::uint32_t v) {
          return std::abs(glm::dot(mesh.positions[v] - own.point, own.normal)) <= 4.0 * mesh.tolerance;
        });
  }
  return result;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<DecalFace> lay_decals(Working& mesh, const Topology& topology, std::span<const Material> materials) {
  const std::vector<detail::FlatComponent> components = detail::flat_components(mesh, topology, materials);
  const auto may_lie = [](const detail::FlatComponent& c) { return c.open && !c.emits; };
  std::vector<DecalFace> found;
  if (std::none_of(components.begin(), components.end(), may_lie)) { return found; }
  const FacesBeside beside(mesh, topology);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (may_lie(components[topology.component[f]])) { faces.push_back(f); }
  }
  // The largest first, because others may lie on them.
  std::stable_sort(faces.begin(), faces.end(), [&](std::uint32_t a, std::uint32_t b) {
    return components[topology.component[a]].area > components[topology.component[b]].area;
  });
  for (const std::uint32_t f : faces) {
    const detail::FlatComponent& own = components[topology.component[f]];
    std::vector<Contact> contacts = beside.contacts(f, 4.0 * mesh.tolerance);
    const double area = own.flat ? own.area : brep::area(mesh.outline(mesh.faces[f]));
    std::erase_if(contacts, [&](const Contact& contact) {
      return !((own.flat ? components[topology.component[contact.face]].area : brep::area(mesh.outline(mesh.faces[contact.face]))) > area);
    });
    if (contacts.empty()) { continue; }
    for (const Contact& contact : contacts) { found.push_back({f, contact.face, contact.opposite, own.flat}); }
    if (own.flat) { beside.lay(f, contacts[0], ChangeKind::decal_laid); }
  }
  return found;
}

namespace detail {

// How much of a component lies on others, by its orientation relative to their visible sides.
struct Lies {
  double same = 0.0, opposite = 0.0;  // areas
  bool unclear = false;
};

}  // namespace detail

HALFLIGHT_INLINE void mark_decals(Working& mesh, const Topology& topology, std::span<const DecalFace> decals,
                                  const std::vector<bool>& backs, Shells& shells) {
  const auto area_of = [&](std::uint32_t face) { return brep::area(mesh.outline(mesh.faces[face])); };
  const auto shows_back = [&](std::uint32_t face) {
    const Component& c = shells.components()[topology.component[face]];
    return c.role == Role::surface && !c.one_sided && (c.both_sides || backs[face]);
  };
  const auto lies = [&](std::span<const DecalFace> own) {
    detail::Lies result;
    for (std::size_t first = 0, end = 0; first < own.size(); first = end) {
      const std::uint32_t face = own[first].face;
      const bool turned = shells.turned(topology.component[face]);
      bool same = false, opposite = false;
      for (; end < own.size() && own[end].face == face; ++end) {
        const std::uint32_t under = own[end].under, component = topology.component[under];
        if (shells.components()[component].role == Role::nothing) { continue; }
        const bool faces_it = own[end].opposite != (shells.turned(component) != turned);
        (faces_it ? opposite : same) = true;
        result.unclear = result.unclear || (faces_it && (shows_back(under) || !shows_back(face)));
      }
      result.same += same ? area_of(face) : 0.0;
      result.opposite += opposite ? area_of(face) : 0.0;
    }
    return result;
  };
  const auto stands_before = [&](const DecalFace& f) {
    const std::uint32_t own = topology.component[f.face], under = topology.component[f.under];
    const bool opposite = f.opposite != (shells.turned(own) != shells.turned(under));
    return shells.components()[own].role == Role::surface && (!opposite || shows_back(f.face) || shows_back(f.under));
  };
  std::map<std::uint32_t, std::vector<DecalFace>> by_component;
  for (const DecalFace& decal : decals) {
    if (decal.flat) {
      by_component[topology.component[decal.face]].push_back(decal);
    } else if (stands_before(decal)) {
      shells.show_before_others(topology.component[decal.face]);
    }
  }
  std::vector<std::pair<double, std::uint32_t>> by_area;
  for (const auto& [component, own] : by_component) {
    const std::vector<std::uint32_t>& faces = shells.components()[component].faces;
    by_area.emplace_back(std::accumulate(faces.begin(), faces.end(), 0.0, [&](double sum, std::uint32_t f) { return sum + area_of(f); }),
                         component);
  }
  // The largest first, because others may lie on them.
  std::sort(by_area.begin(), by_area.end(),
            [](const auto& a, const auto& b) { return std::tie(b.first, a.second) < std::tie(a.first, b.second); });
  for (const auto& [area, component] : by_area) {
    if (shells.components()[component].role != Role::surface) { continue; }
    const detail::Lies on = lies(by_component[component]);
    if (on.unclear || (on.same > 0.0 && on.opposite > 0.0)) { continue; }
    if (2.0 * std::max(on.same, on.opposite) > area) { shells.lay(component, shells.turned(component) != (on.opposite > 0.0)); }
  }
}

}  // namespace radiosity::intake
