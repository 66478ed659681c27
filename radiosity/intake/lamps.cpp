// SPDX-License-Identifier: MIT
#include <radiosity/intake/lamps.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/bvh.hpp>
#include <raycast/line_query.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>

#include <radiosity/intake/beside.hpp>

namespace radiosity::intake {
namespace detail {

inline constexpr double tol_flush = 1e-3;  // relative to a lamp's size: a lamp as near as this to a wall is meant to lie on it

inline bool shines(const Face& face, std::span<const Material> materials) {
  const auto is_lamp = [&](std::uint32_t m) { return m != none && !is_black(materials[m].emission); };
  return is_lamp(face.material) || is_lamp(face.back);
}

// By face: does it emit and belong to an open component?
inline std::vector<bool> open_lamps(const Working& mesh, const Topology& topology, std::span<const Material> materials) {
  std::vector<bool> open(topology.components, false);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::uint32_t s = topology.first[f]; s < topology.first[f + 1]; ++s) {
      if (topology.mate[s] == none) { open[topology.component[f]] = true; }
    }
  }
  std::vector<bool> lamp(mesh.faces.size(), false);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) { lamp[f] = open[topology.component[f]] && shines(mesh.faces[f], materials); }
  return lamp;
}

// Does anything that the lamp could light lie on the side to which `normal` points, more than `height` away?
inline bool any_above(const Working& mesh, std::uint32_t face, const glm::dvec3& normal, double height) {
  const double at = glm::dot(normal, mesh.positions[mesh.faces[face].corners[0]]) + height;
  return std::any_of(mesh.faces.begin(), mesh.faces.end(), [&](const auto& other) {
    return std::any_of(other.corners.begin(), other.corners.end(),
                       [&](std::uint32_t v) { return glm::dot(normal, mesh.positions[v]) > at; });
  });
}

// Up to these distances from a surface, relative to its size, a lamp is not meant to shine into the gap: whatever its file says, or where
// nothing but the order of its corners says so.
inline constexpr double close = 0.02, close_as_a_guess = 0.1;

struct FaceBefore {
  std::uint32_t face = 0;
  double distance = 0.0;  // relative to the size of the lamp
};

// The face close in front of a lamp's centre, if the way behind it is free for ten times the distance, and of `close` at least. `side`: 1;
// or -1 for close behind it and free in front.
inline std::optional<FaceBefore> face_before(Working& mesh, const raycast::Bvh& bvh, const std::vector<bool>& lamp, std::uint32_t face,
                                             double side) {
  const std::span<const glm::dvec3> outline = mesh.outline(mesh.faces[face]);
  const double size = std::sqrt(brep::area(outline));
  const glm::dvec3 normal = side * raycast::plane_of(outline).normal, middle = brep::centroid(outline);
  constexpr double reach = 10.0 * close_as_a_guess;
  std::optional<std::uint32_t> before;
  double nearest = close_as_a_guess * size, behind = HUGE_VAL;
  const raycast::Segment through{middle - reach * size * normal, (reach + close_as_a_guess) * size * normal};
  static_cast<void>(raycast::any_along(bvh, raycast::SlabTest(through), 0.0, 1.0, [&](std::uint32_t other) {
    const raycast::Plane plane = raycast::plane_of(mesh.outline(mesh.faces[other]));
    const double along = glm::dot(plane.normal, normal), height = glm::dot(plane.point - middle, plane.normal);
    if (other == face || along == 0.0 || raycast::RayFrame(through).winding(mesh.outline(mesh.faces[other])) == 0) { return false; }
    const double way = height / along;  // distance along the lamp's normal
    if (way < 0.0) { behind = std::min(behind, -way); }
    if (way > 0.0 && way <= nearest && std::abs(along) > 0.99 && !lamp[other]) {
      nearest = way;
      before = other;
    }
    return false;
  }));
  const double free = std::max(10.0 * close * size, 10.0 * nearest);
  if (!before || behind < free || !any_above(mesh, face, -normal, free)) { return std::nullopt; }
  return FaceBefore{*before, nearest / size};
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<FlushFace> lay_lamps(Working& mesh, const Topology& topology, std::span<const Material> materials) {
  const std::vector<bool> lamp = detail::open_lamps(mesh, topology, materials);
  std::vector<FlushFace> found;
  if (std::none_of(lamp.begin(), lamp.end(), [](bool is) { return is; })) { return found; }
  const FacesBeside beside(mesh, topology);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (!lamp[f]) { continue; }
    const double size = std::sqrt(brep::area(mesh.outline(mesh.faces[f])));
    std::vector<Contact> contacts = beside.contacts(f, std::max(4.0 * mesh.tolerance, detail::tol_flush * size));
    std::erase_if(contacts, [&](const Contact& contact) { return lamp[contact.face]; });
    if (contacts.empty()) {
      for (const double side : {1.0, -1.0}) {
        const auto near = detail::face_before(mesh, beside.bvh(), lamp, f, side);
        if (!near) { continue; }
        const glm::dvec3 normal = brep::vector_area(mesh.outline(mesh.faces[f]));
        const bool opposite = glm::dot(normal, brep::vector_area(mesh.outline(mesh.faces[near->face]))) < 0.0;
        found.push_back({f, near->face, opposite, side > 0.0 ? FlushFace::Gap::before : FlushFace::Gap::behind, near->distance});
      }
      continue;
    }
    const double same = std::abs(contacts[0].height) + 4.0 * mesh.tolerance;
    std::erase_if(contacts, [&](const Contact& contact) { return std::abs(contact.height) > same; });
    for (const Contact& contact : contacts) { found.push_back({f, contact.face, contact.opposite}); }
    beside.lay(f, contacts[0], ChangeKind::lamp_laid);
  }
  return found;
}

HALFLIGHT_INLINE void turn_lamps(Working& mesh, const Topology& topology, std::span<const Material> materials,
                                 std::span<const FlushFace> flush, const std::vector<bool>& backs, bool sides_unknown, Shells& shells) {
  struct Lamp {
    double area = 0.0, front = 0.0, back = 0.0;  // emitting area; parts of it with something directly in front, directly behind
    double gap_before = 0.0, gap_behind = 0.0;   // parts of it with the front of something close in front, close behind
    double wide_before = 0.0;                    // the same in front, with the distance that counts where the side is a guess
    bool one_sided = true, both_shine = true;
    std::uint32_t polygon = none;
  };
  std::map<std::uint32_t, Lamp> lamps;  // by component
  for (std::size_t first = 0, end = 0; first < flush.size(); first = end) {
    bool front = false, back = false, before = false, behind = false, wide = false;
    const std::uint32_t face = flush[first].lamp;
    for (; end < flush.size() && flush[end].lamp == face; ++end) {
      const std::uint32_t under = flush[end].under, component = topology.component[under];
      const Component& shell = shells.components()[component];
      if (shell.role == Role::nothing) { continue; }
      const bool both = shell.role == Role::surface && !shell.one_sided && backs[under];
      const bool opposite = flush[end].opposite != shells.turned(component);
      const bool into_front = flush[end].gap == FlushFace::Gap::before && (both || opposite), near = flush[end].distance <= detail::close;
      wide = wide || into_front;
      before = before || (near && into_front);
      behind = behind || (near && flush[end].gap == FlushFace::Gap::behind && (both || !opposite));
      if (flush[end].gap != FlushFace::Gap::no) { continue; }
      front = front || both || opposite;
      back = back || both || !opposite;
    }
    Lamp& lamp = lamps[topology.component[face]];
    const double area = brep::area(mesh.outline(mesh.faces[face]));
    lamp.gap_before += before ? area : 0.0;
    lamp.gap_behind += behind ? area : 0.0;
    lamp.wide_before += wide ? area : 0.0;
    lamp.front += front ? area : 0.0;
    lamp.back += back ? area : 0.0;
  }
  for (auto& [component, lamp] : lamps) {
    for (const std::uint32_t f : shells.components()[component].faces) {
      if (!detail::shines(mesh.faces[f], materials)) { continue; }
      lamp.area += brep::area(mesh.outline(mesh.faces[f]));
      lamp.one_sided = lamp.one_sided && !backs[f];
      lamp.both_shine = lamp.both_shine && backs[f];
      lamp.polygon = std::min(lamp.polygon, mesh.faces[f].polygon);
    }
    const bool front = 2.0 * lamp.front > lamp.area, back = 2.0 * lamp.back > lamp.area;
    if (shells.components()[component].role != Role::surface) { continue; }
    const bool before = 2.0 * lamp.gap_before > lamp.area, behind = 2.0 * lamp.gap_behind > lamp.area;
    const bool before_as_a_guess = sides_unknown && 2.0 * lamp.wide_before > lamp.area;
    if (!front && !back && (before || before_as_a_guess) && lamp.one_sided) {
      shells.turn(component);
      mesh.changed(ChangeKind::lamp_turned, lamp.polygon);
    }
    if (!front && !back && before != behind && lamp.both_shine) {
      shells.show_one_side(component, before);
      mesh.changed(ChangeKind::lamp_halved, lamp.polygon);
    }
    if (!front && !back) { continue; }
    const bool turn = front && !back;
    shells.lay(component, turn, !(front && back));
    if (turn && lamp.one_sided) { mesh.changed(ChangeKind::lamp_turned, lamp.polygon); }
  }
}

}  // namespace radiosity::intake
