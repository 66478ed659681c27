// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/surface.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/refine.hpp>
#include <brep/result.hpp>
#include <brep/small_list.hpp>
#include <brep/split.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/corner_normal.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

// Chord error of the first approximation of an object of this size, the diagonal of its bounds: 1 % of the size, and up to 3 % where
// facets of a sphere would be smaller than `least_facet`. (A facet of the width w on a sphere of radius r departs from it by w^2 / 8r, and
// the size of the sphere is 2 sqrt(3) r.) With 5 %, which is 24 faces for a sphere, rays aimed at small bright ones were biased by .3 %.
[[nodiscard]] HALFLIGHT_INLINE double first_chord_error(double size, double least_facet) {
  const double relative = least_facet / size;
  return std::clamp(0.25 * std::sqrt(3.0) * relative * relative, 0.01, 0.03) * size;
}

HALFLIGHT_INLINE SurfaceResult make_surface(const raycast::PlacedObject& object, std::uint32_t first_surface, double least_facet) {
  const raycast::Box box = object.bounds();
  brep::Builder builder;
  object.approximate(first_chord_error(glm::length(box.hi - box.lo), least_facet), builder);
  auto closed = brep::close<SurfaceBRep>(builder);
  if (!closed.brep) {
    std::string sentence = "its approximation is not a closed boundary";
    for (const auto& defect : closed.defects) { sentence += "; " + defect.sentence; }
    return {std::nullopt, std::move(sentence)};
  }
  Surface surface{&object, first_surface, std::move(*closed.brep), Topology::shared};
  std::vector<brep::FaceId> concave;
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    if (surface.brep.data(f).sheet != brep::no_sheet && !brep::is_convex(surface.brep, f)) { concave.push_back(f); }
  }
  for (const brep::FaceId f : concave) {
    // A chord face that was cut along another solid need not be planar, a sliver of one may touch itself or lose its area when its corners
    // are rounded, and so may the outline of a plane face that comes near itself.
    if (const auto parts = brep::split_nearly_simple(surface.brep, f); !parts) { return {std::nullopt, parts.refusal().sentence()}; }
  }
  for (const brep::FaceId f : brep::faces(surface.brep)) { surface.brep.data(f).part = f.index; }
  return {std::move(surface), {}};
}

HALFLIGHT_INLINE Polygon corner_polygon(const SurfaceBRep& brep, brep::FaceId f) {
  Polygon polygon;
  for (const brep::HalfedgeId h : brep::corners(brep, f)) { polygon.push_back(brep.data(brep.vertex(h)).position); }
  return polygon;
}

HALFLIGHT_INLINE glm::dvec3 on_sheets(const raycast::PlacedObject& object, std::span<const std::uint32_t> sheets, glm::dvec3 p) {
  for (int round = 0; round < 8; ++round) {
    const glm::dvec3 before = p;
    for (const std::uint32_t sheet : sheets) {
      if (sheet != brep::no_sheet) { p = object.vertex(sheet, p); }
    }
    if (p == before) { break; }
  }
  return p;
}

// How far the border of a plane face departs from the chords between its corners, where it runs between two sheets of a curved object:
// twice the distance at the middles of the chords, which is an upper bound for arcs of ellipses.
[[nodiscard]] HALFLIGHT_INLINE double rim(const Surface& surface, brep::FaceId f) {
  if (surface.topology != Topology::shared) { return 0.0; }
  const SurfaceBRep& brep = surface.brep;
  const auto position = [&](brep::HalfedgeId h) { return brep.data(brep.vertex(h)).position; };
  const std::uint32_t own = brep.data(f).sheet;
  const auto corners = brep::corners(brep, f);
  double result = 0.0;
  for (auto h = corners.begin(); h != corners.end();) {
    const std::uint32_t across = brep.data(brep.face(brep::twin(*h))).sheet;
    const glm::dvec3 from = position(*h);
    ++h;
    const glm::dvec3 to = position(h != corners.end() ? *h : *corners.begin());
    if (across == own) { continue; }
    const glm::dvec3 middle = 0.5 * (from + to);
    result = std::max(result, 2.0 * glm::length(on_sheets(*surface.object, std::array{own, across}, middle) - middle));
  }
  return result;
}

HALFLIGHT_INLINE Node make_leaf(Surface& surface, std::uint32_t object, brep::FaceId f, std::uint32_t parent, std::uint32_t index) {
  const Polygon polygon = corner_polygon(surface.brep, f);
  Node node;
  const glm::dvec3 area = vector_area(polygon);
  node.area = glm::length(area);
  node.normal = node.area > 0.0 ? area / node.area : glm::dvec3{0.0};
  for (const glm::dvec3& p : polygon) { node.centre += p / static_cast<double>(polygon.size()); }
  for (const glm::dvec3& p : polygon) { node.radius = std::max(node.radius, glm::length(p - node.centre)); }
  if (!surface.object->flat()) {
    const std::uint32_t sheet = surface.brep.data(f).sheet;
    for (const glm::dvec3& p : polygon) {
      const glm::dvec3 true_normal = corner_normal(*surface.object, sheet, p, node.centre);
      node.deviation = std::max(node.deviation, std::min(1.0, glm::length(glm::cross(node.normal, true_normal))));
    }
    if (node.deviation < 1e-9) { node.rim = rim(surface, f); }
  }
  node.parent = parent;
  node.object = object;
  node.surface = surface.first_surface + surface.brep.data(f).sheet;
  node.corners = static_cast<std::uint32_t>(polygon.size());
  node.face = f;
  surface.brep.data(f).node = index;
  return node;
}

HALFLIGHT_INLINE std::size_t radiating_faces(const Surface& surface) {
  std::size_t count = 0;
  for (const brep::FaceId f : brep::faces(surface.brep)) { count += surface.brep.data(f).sheet != brep::no_sheet ? 1 : 0; }
  return count;
}

HALFLIGHT_INLINE std::vector<std::vector<brep::FaceId>> input_faces(const Surface& surface) {
  const SurfaceBRep& brep = surface.brep;
  std::vector<std::vector<brep::FaceId>> result;
  std::vector<bool> seen(brep.face_end(), false);
  for (const brep::FaceId f : brep::faces(brep)) {
    if (seen[f.index] || brep.data(f).sheet == brep::no_sheet) { continue; }
    std::vector<brep::FaceId>& parts = result.emplace_back(1, f);
    seen[f.index] = true;
    if (!surface.object->flat()) { continue; }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, parts[i])) {
        const brep::FaceId across = brep.face(brep::twin(h));
        if (seen[across.index] || brep.data(across).sheet != brep.data(f).sheet) { continue; }
        seen[across.index] = true;
        parts.push_back(across);
      }
    }
    std::vector<std::uint32_t> from;
    for (const brep::FaceId part : parts) { from.push_back(brep.data(part).part); }
    std::sort(from.begin(), from.end());
    if (std::adjacent_find(from.begin(), from.end()) == from.end()) { continue; }
    const std::vector<brep::FaceId> cut = std::move(parts);
    result.pop_back();
    for (const brep::FaceId part : cut) { result.emplace_back(1, part); }
  }
  return result;
}

HALFLIGHT_INLINE Hierarchy make_roots(std::vector<Surface>& surfaces, std::pmr::memory_resource* arrays) {
  Hierarchy hierarchy(arrays);
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    for (const std::vector<brep::FaceId>& parts : input_faces(surfaces[o])) {
      const auto root = static_cast<std::uint32_t>(hierarchy.size());
      if (parts.size() == 1) {
        hierarchy.push_back(make_leaf(surfaces[o], o, parts[0], no_node, root));
        continue;
      }
      hierarchy.emplace_back();
      glm::dvec3 area{0.0};
      Node whole;
      for (const brep::FaceId f : parts) {
        const auto index = static_cast<std::uint32_t>(hierarchy.size());
        hierarchy.push_back(make_leaf(surfaces[o], o, f, root, index));
        area += hierarchy[index].area * hierarchy[index].normal;
        whole.centre += hierarchy[index].area * hierarchy[index].centre;
        whole.area += hierarchy[index].area;
      }
      whole.centre = whole.area > 0.0 ? whole.centre / whole.area : hierarchy[root + 1].centre;
      whole.normal = glm::length(area) > 0.0 ? glm::normalize(area) : glm::dvec3{0.0};
      for (std::size_t i = root + 1; i < hierarchy.size(); ++i) {
        for (const glm::dvec3& p : corner_polygon(surfaces[o].brep, hierarchy[i].face)) {
          whole.radius = std::max(whole.radius, glm::length(p - whole.centre));
        }
      }
      whole.surface = hierarchy[root + 1].surface;
      whole.object = o;
      whole.first_child = root + 1;
      whole.child_count = static_cast<std::uint32_t>(parts.size());
      hierarchy[root] = whole;
    }
  }
  return hierarchy;
}

// The contour of a polygon given by convex parts with bitwise equal corners, with a bridge to each hole. Diagonals of a spanning tree of
// the parts (each joins two that were not connected yet) are removed, so that the parts become one disk. The remaining diagonals are
// bridges, which are kept, or slits that lead to an inner corner, which are removed.
[[nodiscard]] HALFLIGHT_INLINE Polygon contour_of_parts(const std::vector<Polygon>& parts) {
  struct Side {
    std::array<double, 6> ends;
    std::size_t part, corner;
    bool vanished = false;
    bool operator<(const Side& other) const { return ends < other.ends; }
  };
  const auto ends = [](const glm::dvec3& a, const glm::dvec3& b) { return std::array<double, 6>{a.x, a.y, a.z, b.x, b.y, b.z}; };
  const auto next = [&](std::size_t part, std::size_t corner) { return corner + 1 < parts[part].size() ? corner + 1 : 0; };
  std::vector<Side> sides;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (std::size_t i = 0; i < parts[k].size(); ++i) { sides.push_back({ends(parts[k][i], parts[k][next(k, i)]), k, i}); }
  }
  std::sort(sides.begin(), sides.end());
  const auto find_side = [&](const glm::dvec3& a, const glm::dvec3& b) {
    const auto found = std::lower_bound(sides.begin(), sides.end(), Side{ends(a, b), 0, 0});
    return found != sides.end() && found->ends == ends(a, b) ? &*found : nullptr;
  };
  std::vector<std::size_t> group(parts.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto root = [&](std::size_t k) {
    while (group[k] != k) { k = group[k] = group[group[k]]; }
    return k;
  };
  const Side* start = nullptr;
  for (Side& side : sides) {
    Side* const back = find_side(parts[side.part][next(side.part, side.corner)], parts[side.part][side.corner]);
    if (back == nullptr) {
      start = &side;
    } else if (root(side.part) != root(back->part)) {
      group[root(side.part)] = root(back->part);
      side.vanished = back->vanished = true;
    }
  }
  Polygon polygon;
  const Side* side = start;
  do {
    const glm::dvec3& corner_of_side = parts[side->part][side->corner];
    if (polygon.size() > 1 && polygon[polygon.size() - 2] == corner_of_side) {
      polygon.pop_back();  // remove a slit: to its end and back
    } else {
      polygon.push_back(corner_of_side);
    }
    for (std::size_t part = side->part, corner = side->corner;;) {
      corner = next(part, corner);
      const glm::dvec3 &from = parts[part][corner], &to = parts[part][next(part, corner)];
      side = find_side(from, to);
      if (!side->vanished) { break; }
      const Side* const back = find_side(to, from);
      part = back->part, corner = back->corner;
    }
  } while (side != start);
  while (polygon.size() > 2 && polygon[polygon.size() - 2] == polygon.front()) {
    polygon.resize(polygon.size() - 2);
  }  // a slit at the start
  return polygon;
}

HALFLIGHT_INLINE Polygon contour(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy, std::uint32_t index) {
  const auto corner0 = [&](std::uint32_t i) {
    while (!hierarchy[i].leaf()) { i = hierarchy[i].first_child; }
    const SurfaceBRep& brep = surfaces[hierarchy[i].object].brep;
    return brep.data(brep.vertex(brep::corners(brep, hierarchy[i].face)[0])).position;
  };
  const Node& node = hierarchy[index];
  if (node.leaf()) { return corner_polygon(surfaces[node.object].brep, node.face); }
  if (node.in_parts()) {
    std::vector<Polygon> parts;
    for (std::uint32_t k = 0; k < node.child_count; ++k) { parts.push_back(contour(surfaces, hierarchy, node.first_child + k)); }
    return contour_of_parts(parts);
  }
  Polygon polygon;
  for (std::uint32_t k = 0; k < node.corners; ++k) { polygon.push_back(corner0(node.first_child + k)); }
  return polygon;
}

}  // namespace radiosity
