// SPDX-License-Identifier: MIT
#include <radiosity/visibility/enclosure.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/union_find.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/object.hpp>
#include <raycast/point_query.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/visibility/edge_sum.hpp>

namespace radiosity {

namespace detail {

// A convex face.
struct FrontFace {
  Polygon contour;
  glm::dvec3 normal{0.0};  // unit length
  std::uint32_t object = 0;
};

// Adds the faces of a surface that belong to sheets, except those without area.
HALFLIGHT_INLINE void add_fronts(const Surface& surface, std::uint32_t object, std::vector<FrontFace>& faces) {
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    if (surface.brep.data(f).sheet == brep::no_sheet) { continue; }
    Polygon contour = corner_polygon(surface.brep, f);
    const glm::dvec3 area = brep::vector_area(contour);
    const double length = glm::length(area);
    if (length > 0.0) { faces.push_back({std::move(contour), area / length, object}); }
  }
}

// Does an edge of `a` pass through the inside of `b`? Touching does not count.
[[nodiscard]] HALFLIGHT_INLINE bool pierces(const FrontFace& a, const FrontFace& b) {
  for (std::size_t i = 0; i < a.contour.size(); ++i) {
    const glm::dvec3& p = a.contour[i];
    const glm::dvec3& q = a.contour[(i + 1) % a.contour.size()];
    const double hp = glm::dot(b.normal, p - b.contour[0]);
    const double hq = glm::dot(b.normal, q - b.contour[0]);
    if (!(std::min(hp, hq) < -enclosure_slack && std::max(hp, hq) > enclosure_slack)) { continue; }
    const glm::dvec3 x = p + hp / (hp - hq) * (q - p);
    bool inside = true;
    for (std::size_t k = 0; k < b.contour.size() && inside; ++k) {
      const glm::dvec3 edge = b.contour[(k + 1) % b.contour.size()] - b.contour[k];
      inside = glm::dot(glm::cross(b.normal, edge), x - b.contour[k]) > enclosure_slack * glm::length(edge);
    }
    if (inside) { return true; }
  }
  return false;
}

// Does any of the first `walls` faces intersect another face?
[[nodiscard]] HALFLIGHT_INLINE bool any_crossing(const std::vector<FrontFace>& faces, std::size_t walls) {
  std::vector<raycast::Box> boxes;
  for (const FrontFace& face : faces) {
    raycast::Box box;
    for (const glm::dvec3& p : face.contour) { box.extend(p); }
    boxes.push_back(box);
  }
  const raycast::Bvh tree{boxes};
  for (std::size_t i = 0; i < walls; ++i) {
    const raycast::Box& own = boxes[i];
    const bool found = raycast::any_within(
        tree, [&](const raycast::Box& box) { return box.meets(own); },
        [&](std::uint32_t j) { return j != i && (pierces(faces[i], faces[j]) || pierces(faces[j], faces[i])); });
    if (found) { return true; }
  }
  return false;
}

// The winding number of the faces around x, with half the weight for a face that x lies on: from the solid angle of each (van Oosterom
// and Strackee 1983).
[[nodiscard]] HALFLIGHT_INLINE double winding(std::span<const FrontFace> faces, const glm::dvec3& x) {
  double angle = 0.0;
  for (const FrontFace& face : faces) {
    if (std::abs(glm::dot(face.normal, x - face.contour[0])) <= enclosure_slack) { continue; }  // seen edge-on, or x lies on it
    const glm::dvec3 a = glm::normalize(face.contour[0] - x);
    for (std::size_t k = 2; k < face.contour.size(); ++k) {
      const glm::dvec3 b = glm::normalize(face.contour[k - 1] - x);
      const glm::dvec3 c = glm::normalize(face.contour[k] - x);
      angle -= 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    }
  }
  return angle / (4.0 * std::numbers::pi);
}

[[nodiscard]] HALFLIGHT_INLINE glm::dvec3 middle_of(const FrontFace& face) {
  return std::accumulate(face.contour.begin(), face.contour.end(), glm::dvec3{0.0}) / static_cast<double>(face.contour.size());
}

// The six sides of a box, used for a solid that is curved or has many faces.
[[nodiscard]] HALFLIGHT_INLINE std::vector<FrontFace> faces_of_box(const raycast::Box& box, std::uint32_t object) {
  std::vector<FrontFace> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      FrontFace face{{}, glm::dvec3{0.0}, object};
      face.normal[axis] = high ? 1.0 : -1.0;
      for (const auto& [u, v] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
        glm::dvec3 p{0.0};
        p[axis] = high ? box.hi[axis] : box.lo[axis];
        p[(axis + 1) % 3] = u != 0 ? box.hi[(axis + 1) % 3] : box.lo[(axis + 1) % 3];
        p[(axis + 2) % 3] = v != 0 ? box.hi[(axis + 2) % 3] : box.lo[(axis + 2) % 3];
        face.contour.push_back(p);
      }
      if (!high) { std::reverse(face.contour.begin(), face.contour.end()); }
      faces.push_back(std::move(face));
    }
  }
  return faces;
}

// One face of each set of faces connected by edges with exactly two faces.
[[nodiscard]] HALFLIGHT_INLINE std::vector<std::size_t> one_of_each_part(const std::vector<FrontFace>& faces, EdgeSum& corners) {
  std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> of_edge;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const Polygon& contour = faces[i].contour;
    for (std::size_t k = 0; k < contour.size(); ++k) {
      const std::uint32_t a = corners.corner(contour[k]);
      const std::uint32_t b = corners.corner(contour[(k + 1) % contour.size()]);
      of_edge[{std::min(a, b), std::max(a, b)}].push_back(i);
    }
  }
  brep::detail::UnionFind sets(faces.size());
  for (const auto& [edge, of] : of_edge) {
    if (of.size() == 2) { sets.unite(of[0], of[1]); }
  }
  std::vector<std::size_t> parts;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    if (sets.find(i) == i) { parts.push_back(i); }
  }
  return parts;
}

// The area of a convex polygon that is covered by another convex polygon in the same plane, both counter-clockwise about `normal`.
[[nodiscard]] HALFLIGHT_INLINE double covered_area(Polygon polygon, const Polygon& cover, const glm::dvec3& normal) {
  Polygon part;
  for (std::size_t i = 0; i < cover.size() && polygon.size() > 2; ++i) {
    const glm::dvec3 inwards = glm::cross(normal, cover[(i + 1) % cover.size()] - cover[i]);
    const double length = glm::length(inwards);
    if (!(length > 0.0)) { continue; }
    part.clear();
    clip_to_horizon(polygon, cover[i], inwards / length, part);
    std::swap(polygon, part);
  }
  return polygon.size() > 2 ? std::max(0.0, glm::dot(normal, brep::vector_area(polygon))) : 0.0;
}

}  // namespace detail

HALFLIGHT_INLINE bool lies_on(const Surface& surface, const std::vector<const Surface*>& walls) {
  std::vector<detail::FrontFace> faces;
  for (const Surface* wall : walls) { detail::add_fronts(*wall, 0, faces); }
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    if (surface.brep.data(f).sheet == brep::no_sheet) { continue; }
    const Polygon polygon = corner_polygon(surface.brep, f);
    const glm::dvec3 area = brep::vector_area(polygon);
    const double whole = glm::length(area);
    if (!(whole > 0.0)) { return false; }
    double border = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) { border += glm::length(polygon[(i + 1) % polygon.size()] - polygon[i]); }
    double covered = 0.0;
    for (const detail::FrontFace& wall : faces) {
      const auto in_plane = [&](const glm::dvec3& p) {
        return std::abs(glm::dot(wall.normal, p - wall.contour[0])) <= detail::enclosure_slack;
      };
      if (!(glm::dot(wall.normal, area) > 0.999 * whole) || !std::all_of(polygon.begin(), polygon.end(), in_plane)) { continue; }
      covered += detail::covered_area(polygon, wall.contour, wall.normal);
    }
    if (covered < whole - detail::enclosure_slack * border) { return false; }
  }
  return true;
}

namespace detail {

HALFLIGHT_INLINE std::vector<FrontFace> fronts_of(const std::vector<Surface>& surfaces, const std::vector<std::uint32_t>& objects) {
  std::vector<FrontFace> faces;
  for (const std::uint32_t o : objects) { add_fronts(surfaces[o], o, faces); }
  return faces;
}

HALFLIGHT_INLINE EdgeSum edges_of(const std::vector<FrontFace>& faces) {
  EdgeSum sum;
  for (const FrontFace& face : faces) { sum.add(face.contour); }
  return sum;
}

// Faces without a border that include all, or nearly all, of these sheets; sheets at a border may lie on the others. Empty if there are
// none.
HALFLIGHT_INLINE std::vector<FrontFace> closed_walls(const std::vector<Surface>& surfaces, const std::vector<std::uint32_t>& sheets) {
  std::vector<FrontFace> faces = fronts_of(surfaces, sheets);
  if (faces.size() < 4) { return {}; }
  EdgeSum sum = edges_of(faces);
  const auto border = sum.border();
  if (!border) { return {}; }
  if (border->empty()) { return faces; }
  std::vector<std::uint32_t> walls;
  std::vector<std::uint32_t> others;
  for (const std::uint32_t o : sheets) {
    const auto of_object = [&](const FrontFace& face) { return face.object == o && sum.touches(*border, face.contour); };
    (std::any_of(faces.begin(), faces.end(), of_object) ? others : walls).push_back(o);
  }
  if (others.size() > 64) { return {}; }
  std::vector<const Surface*> behind;
  for (const std::uint32_t o : walls) { behind.push_back(&surfaces[o]); }
  if (!std::all_of(others.begin(), others.end(), [&](std::uint32_t o) { return lies_on(surfaces[o], behind); })) { return {}; }
  faces = fronts_of(surfaces, walls);
  const auto rest = edges_of(faces).border();
  if (faces.size() < 4 || !rest || !rest->empty()) { return {}; }
  return faces;
}

// Does a solid lie within the walls, or on their inner side? If so, adds its faces, or those of its bounds, to `all`.
HALFLIGHT_INLINE bool add_within(const Surface& solid, std::uint32_t number, std::span<const FrontFace> walls,
                                 std::vector<FrontFace>& all) {
  std::vector<FrontFace> own;
  if (solid.object->flat()) { add_fronts(solid, number, own); }
  if (own.empty() || own.size() > 100) { own = faces_of_box(solid.object->bounds(), number); }
  double most = 0.0;
  for (const FrontFace& face : own) {
    const double around = winding(walls, middle_of(face));
    if (around < 0.49) { return false; }
    most = std::max(most, around);
  }
  if (most < 0.99) { return false; }
  all.insert(all.end(), own.begin(), own.end());
  return true;
}

}  // namespace detail

HALFLIGHT_INLINE bool enclosed_by_sheets(const std::vector<Surface>& surfaces) {
  std::vector<std::uint32_t> sheets;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (surfaces[o].object->inside()) { return false; }
    if (surfaces[o].object->solid()) { continue; }
    if (!surfaces[o].object->flat()) { return false; }
    sheets.push_back(o);
  }
  const std::vector<detail::FrontFace> walls = detail::closed_walls(surfaces, sheets);
  if (walls.empty()) { return false; }
  detail::EdgeSum corners = detail::edges_of(walls);
  const std::vector<std::size_t> parts = detail::one_of_each_part(walls, corners);
  if (parts.size() > detail::most_enclosure_parts) { return false; }
  for (const std::size_t part : parts) {
    if (std::abs(detail::winding(walls, detail::middle_of(walls[part])) - 0.5) > 0.01) { return false; }
  }
  std::vector<detail::FrontFace> all = walls;
  std::size_t looked_at = 0;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (!surfaces[o].object->solid()) { continue; }
    if (++looked_at > detail::most_enclosure_parts || !detail::add_within(surfaces[o], o, walls, all)) { return false; }
  }
  return !detail::any_crossing(all, walls.size());
}

}  // namespace radiosity
