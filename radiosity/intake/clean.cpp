// SPDX-License-Identifier: MIT
#include <radiosity/intake/clean.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/ears.hpp>
#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/planar.hpp>
#include <raycast/tolerances.hpp>

#include <radiosity/support/draw.hpp>

namespace radiosity::intake {
namespace detail {

inline constexpr std::size_t most_corners = 1024;  // the search for self-intersections is quadratic
inline constexpr std::size_t most_split = 20'000;  // triangulation is quadratic, too: two seconds for this many

// Replaces a b b c by a b c, and a b a by a.
inline void simplify(std::vector<std::uint32_t>& corners) {
  for (bool changed = true; changed && corners.size() > 2;) {
    changed = false;
    for (std::size_t i = 0; i < corners.size() && corners.size() > 2; ++i) {
      const std::size_t n = corners.size(), next = (i + 1) % n, after = (i + 2) % n;
      if (corners[i] != corners[next] && corners[i] != corners[after]) { continue; }
      const std::size_t gone = next;
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(gone));
      changed = true;
    }
  }
}

// Height of a triangle over its longest side, 0 if it has no area; for other polygons the area divided by the extent.
inline double width(std::span<const glm::dvec3> p) {
  double longest = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) { longest = std::max(longest, glm::length(p[(i + 1) % p.size()] - p[i])); }
  if (p.size() > 3) { longest = std::max(longest, brep::extent(p)); }
  return longest > 0.0 ? (p.size() == 3 ? 2.0 : 1.0) * brep::area(p) / longest : 0.0;
}

inline bool nearly_planar(const raycast::Plane& plane, std::span<const glm::dvec3> outline, double tolerance) {
  return plane.slack <= std::min(tolerance, 1e-4 * brep::extent(outline));
}

// Does the triangulation have a triangle that is not a sliver? A polygon that crosses itself may have no vector area although
// its triangles have.
inline bool has_triangles(Working& mesh, const Face& face) {
  const std::vector<std::array<std::uint32_t, 3>> triangles = brep::ears(mesh.outline(face));
  return std::any_of(triangles.begin(), triangles.end(), [&](const std::array<std::uint32_t, 3>& t) {
    return width(mesh.outline({face.corners[t[0]], face.corners[t[1]], face.corners[t[2]]})) >= mesh.tolerance;
  });
}

// Triangles that cover parts of a planar outline twice have more area than its vector area. Those of an outline that follows a bridge
// edge to a hole, around it and back, cover it once.
inline bool crosses_itself(std::span<const glm::dvec3> outline, std::span<const std::array<std::uint32_t, 3>> triangles) {
  double covered = 0.0;
  for (const auto& [a, b, c] : triangles) { covered += triangle_area(outline[a], outline[b], outline[c]); }
  const double extent = brep::extent(outline);
  return covered > brep::area(outline) + raycast::tol_area * extent * extent;
}

}  // namespace detail

HALFLIGHT_INLINE void drop_degenerate(Working& mesh) {
  std::erase_if(mesh.faces, [&](Face& face) {
    if (face.corners.size() > detail::most_split) {
      mesh.changed(ChangeKind::too_long, face.polygon);
      return true;
    }
    detail::simplify(face.corners);
    const double width = face.corners.size() < 3 ? 0.0 : detail::width(mesh.outline(face));
    if (width >= mesh.tolerance || (face.corners.size() > 3 && detail::has_triangles(mesh, face))) { return false; }
    const bool area = width > raycast::tol_area * brep::extent(mesh.outline(face));
    mesh.changed(area ? ChangeKind::sliver : ChangeKind::no_area, face.polygon, area ? width : 0.0);
    return true;
  });
}

HALFLIGHT_INLINE void drop_duplicates(Working& mesh, const std::vector<bool>& among, const std::vector<bool>& yielding) {
  struct Key {
    std::vector<std::uint32_t> corners;
    bool stays = true;
    std::uint32_t face = 0;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (among.empty() || among[f]) { keys.push_back({canonical(mesh.faces[f].corners), yielding.empty() || !yielding[f], f}); }
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> gone(mesh.faces.size(), false);
  std::set<std::uint32_t> counted;  // polygons: one may have several faces
  for (std::size_t first = 0, end = 0; first < keys.size(); first = end) {
    while (end < keys.size() && keys[end].corners == keys[first].corners) { ++end; }
    Face& last = mesh.faces[keys[end - 1].face];
    for (std::size_t i = end - 1; i-- > first;) {
      const Face& earlier = mesh.faces[keys[i].face];
      gone[keys[i].face] = true;
      last.stand_for(earlier);
      if (last.back == none) { last.back = earlier.back; }
      if (counted.insert(earlier.polygon).second) { mesh.changed(ChangeKind::duplicate, earlier.polygon); }
    }
  }
  std::erase_if(mesh.faces, [&](const Face& face) { return gone[static_cast<std::size_t>(&face - mesh.faces.data())]; });
}

HALFLIGHT_INLINE bool nearly_sound(std::span<const glm::dvec3> outline, double tolerance) {
  if (outline.size() > detail::most_corners) { return false; }
  if (!raycast::polygon_fault(outline)) { return true; }
  const raycast::Plane plane = raycast::plane_of(outline);
  if (!detail::nearly_planar(plane, outline, tolerance)) { return false; }
  std::vector<glm::dvec3> flat(outline.begin(), outline.end());
  for (glm::dvec3& p : flat) { p -= glm::dot(p - plane.point, plane.normal) * plane.normal; }
  return !raycast::polygon_fault(flat);
}

HALFLIGHT_INLINE void split_faulty(Working& mesh, bool strict) {
  std::vector<Face> faces;
  faces.reserve(mesh.faces.size());
  for (Face& face : mesh.faces) {
    const std::span<const glm::dvec3> outline = mesh.outline(face);
    const bool sound =
        strict ? outline.size() <= detail::most_corners && !raycast::polygon_fault(outline) : nearly_sound(outline, mesh.tolerance);
    if (sound) {
      faces.push_back(std::move(face));
      continue;
    }
    const std::vector<std::array<std::uint32_t, 3>> triangles = brep::ears(outline);
    if (outline.size() > 3) {
      const double slack = raycast::plane_of(outline).slack;
      const bool flat = slack <= raycast::tol_planar * brep::extent(outline);
      const ChangeKind how = !flat                                        ? ChangeKind::not_planar
                             : detail::crosses_itself(outline, triangles) ? ChangeKind::crossing
                                                                          : ChangeKind::touching;
      mesh.changed(how, face.polygon, flat ? 0.0 : slack);
    }
    const std::vector<std::uint32_t> corners = std::move(face.corners);
    face.corners.clear();  // emptied, so that the copies below do not include them
    for (const auto& [a, b, c] : triangles) {
      Face triangle = face;
      triangle.corners = {corners[a], corners[b], corners[c]};
      if (!raycast::polygon_fault(mesh.outline(triangle))) { faces.push_back(std::move(triangle)); }
    }
  }
  mesh.faces = std::move(faces);
}

// Projects each vertex onto the planes of its faces in turn (Kaczmarz 1937), which converges to a point of all planes near the original
// position.
HALFLIGHT_INLINE void flatten(Working& mesh) {
  std::vector<raycast::Plane> planes;
  std::vector<std::uint32_t> polygons;                        // polygon of each plane
  std::vector<std::pair<std::uint32_t, std::uint32_t>> uses;  // vertex, plane
  bool any = false;
  for (const Face& face : mesh.faces) {
    const std::span<const glm::dvec3> outline = mesh.outline(face);
    if (outline.size() == 3) { continue; }  // a triangle is planar in any case
    const raycast::Plane plane = raycast::plane_of(outline);
    if (!detail::nearly_planar(plane, outline, mesh.tolerance)) { continue; }
    any = any || plane.slack > 0.0;
    for (const std::uint32_t v : face.corners) { uses.emplace_back(v, static_cast<std::uint32_t>(planes.size())); }
    planes.push_back(plane);
    polygons.push_back(face.polygon);
  }
  if (!any) { return; }
  std::sort(uses.begin(), uses.end());
  for (std::size_t first = 0, end = 0; first < uses.size(); first = end) {
    const std::uint32_t vertex = uses[first].first;
    std::uint32_t off = uses[first].second;  // the plane with the largest deviation of corners
    for (end = first; end < uses.size() && uses[end].first == vertex; ++end) {
      off = planes[uses[end].second].slack > planes[off].slack ? uses[end].second : off;
    }
    if (!(planes[off].slack > 0.0)) { continue; }
    glm::dvec3 p = mesh.positions[vertex];
    double moved = HUGE_VAL;
    for (int round = 0; round < 64 && moved > 1e-9 * mesh.tolerance; ++round) {
      moved = 0.0;
      for (std::size_t i = first; i < end; ++i) {
        const raycast::Plane& plane = planes[uses[i].second];
        const double height = glm::dot(p - plane.point, plane.normal);
        p -= height * plane.normal;
        moved = std::max(moved, std::abs(height));
      }
    }
    const double distance = glm::length(p - mesh.positions[vertex]);
    if (!(distance > 0.0 && distance <= mesh.tolerance)) { continue; }
    mesh.positions[vertex] = p;
    mesh.changed(ChangeKind::flattened, polygons[off], distance);
  }
}

}  // namespace radiosity::intake
