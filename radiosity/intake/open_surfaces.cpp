// SPDX-License-Identifier: MIT
#include <radiosity/intake/open_surfaces.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

namespace radiosity::intake {
namespace detail {

// Measures of all open surfaces together, but for those most of which shines: a dome of sky is not the wall of a room.
struct OpenSurfaces {
  std::vector<double> area, opening;   // by component, 0 if it is closed or one-sided; opening: area of flat lids on its borders
  std::vector<double> border, met;     // by component: length of its borders, and of the part that coincides with borders of others
  std::vector<std::uint32_t> first;    // by component: its first input polygon
  double whole = 0.0, all_open = 0.0;  // sums of area and opening
  double volume = 0.0;  // signed volume, closed by cones over the borders from their centres; negative if most surfaces look inwards
  raycast::Box model;   // of all components, but for those most of which shines

  OpenSurfaces(Working& mesh, const Topology& topology, const Shells& shells)
      : area(shells.components().size()), opening(area), border(area), met(area), first(area.size(), none), ends_(topology.vertices) {
    std::vector<bool> counts;
    for (const Component& component : shells.components()) {
      const bool lamp = 2.0 * shells.shining_share(component) >= 1.0;
      counts.push_back(component.role == Role::surface && !component.one_sided && !lamp);
      if (!lamp) { model.extend(component.box); }
    }
    glm::dvec3 normals{0.0}, middle{0.0};
    double length = 0.0;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      const std::uint32_t c = topology.component[f];
      if (!counts[c]) { continue; }
      const std::span<const glm::dvec3> p = mesh.outline(mesh.faces[f]);
      const glm::dvec3 normal = brep::vector_area(p);
      area[c] += glm::length(normal);
      first[c] = std::min(first[c], mesh.faces[f].polygon);
      normals += normal;
      volume += glm::dot(p[0], normal) / 3.0;
      for (std::size_t i = 0; i < p.size(); ++i) {
        const std::uint32_t s = topology.first[f] + static_cast<std::uint32_t>(i);
        if (topology.mate[s] != none) { continue; }
        const glm::dvec3 &a = p[i], &b = p[(i + 1) % p.size()];
        const double its = glm::length(b - a);
        const std::vector<std::uint32_t>& corners = mesh.faces[f].corners;
        const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % p.size()]);
        ends_[topology.vertex[s]] = {a, topology.vertex[topology.next(s, f)], c};
        edges_.push_back({low, high, c, its});
        middle += 0.5 * its * (a + b);
        length += its;
      }
    }
    find_openings();
    measure_borders();
    for (std::size_t c = 0; c < area.size(); ++c) {
      whole += area[c];
      all_open += opening[c];
    }
    if (length > 0.0) { volume -= glm::dot(middle / length, normals) / 3.0; }
  }

  // Are these the walls of a room with openings? For a unit cube without one side, seen from inside, volume and opening are
  // -0.09 and 0.2 relative to the area.
  [[nodiscard]] bool are_walls() const {
    constexpr double least_volume = 0.02, most_open = 0.6;
    return volume < -least_volume * std::pow(whole, 1.5) && all_open < most_open * whole;
  }

  // Does it reach from one end of the model to the other, as the walls of a room do and things in the room do not?
  [[nodiscard]] bool spans_model(const Component& component) const {
    constexpr double nearly = 0.9;
    const glm::dvec3 its = component.box.size(), whole_model = nearly * model.size();
    return its.x > whole_model.x || its.y > whole_model.y || its.z > whole_model.z;
  }

 private:
  // A vertex on a border, and the border edge that begins there.
  struct End {
    glm::dvec3 position{0.0};
    std::uint32_t next = none, component = none;
  };

  void find_openings() {
    for (std::uint32_t start = 0; start < ends_.size(); ++start) {
      glm::dvec3 twice{0.0};
      const std::uint32_t c = ends_[start].component;
      const glm::dvec3 origin = ends_[start].position;
      for (std::uint32_t v = start; ends_[v].next != none;) {
        const std::uint32_t next = std::exchange(ends_[v].next, none);
        twice += glm::cross(ends_[v].position - origin, ends_[next].position - origin);
        v = next;
      }
      if (c != none) { opening[c] += 0.5 * glm::length(twice); }
    }
  }

  struct Edge {
    std::uint32_t low, high, component;
    double length;
  };

  void measure_borders() {
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto same = [&](std::size_t k) { return edges_[k].low == edges_[i].low && edges_[k].high == edges_[i].high; };
      border[edges_[i].component] += edges_[i].length;
      if ((i > 0 && same(i - 1)) || (i + 1 < edges_.size() && same(i + 1))) { met[edges_[i].component] += edges_[i].length; }
    }
  }

  std::vector<End> ends_;
  std::vector<Edge> edges_;
};

}  // namespace detail

HALFLIGHT_INLINE void show_both_sides(Working& mesh, const Topology& topology, bool may_turn, Shells& shells) {
  constexpr double tol_opening = 0.02;
  const detail::OpenSurfaces open(mesh, topology, shells);
  const auto is_open = [&](std::uint32_t c) { return open.opening[c] > tol_opening * open.area[c] && 2.0 * open.met[c] < open.border[c]; };
  const std::span<const Component> components = shells.components();
  const bool walls = open.are_walls();
  if (walls && may_turn && components.size() == 1 && !is_open(0) && !shells.shines(components[0])) {
    shells.turn(0);
    mesh.changed(ChangeKind::inside_out, open.first[0]);
  }
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    const bool wall = walls && open.spans_model(components[c]);
    if (is_open(c) && !wall && !shells.shines(components[c])) { shells.show_both_sides(c); }
  }
}

}  // namespace radiosity::intake
