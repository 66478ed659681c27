// SPDX-License-Identifier: MIT
#include <raycast/objects/csg_place.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/outline.hpp>
#include <brep/polygon.hpp>
#include <brep/unchecked.hpp>

#include <raycast/object.hpp>
#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

namespace detail {

HALFLIGHT_INLINE glm::dvec3 towards(const glm::dvec3& p, const std::vector<SurfacePoint>& planes) {
  glm::dvec3 axis[3], way(0.0);
  int count = 0;
  for (const SurfacePoint& plane : planes) {
    glm::dvec3 n = plane.normal;
    for (int i = 0; i < count; ++i) { n -= glm::dot(n, axis[i]) * axis[i]; }
    const double length = glm::length(n);
    if (!(length > tol_plane_angle)) {
      continue;  // nearly parallel to the planes before: the common point is poorly determined along them
    }
    axis[count] = n / length;
    way += (glm::dot(plane.normal, plane.position - p - way) / length) * axis[count];
    if (++count == 3) { break; }
  }
  return p + way;
}

HALFLIGHT_INLINE void CsgPlacement::put_back(CsgBRep& brep, double near) const {
  const CsgBRep before = brep;
  Moved moved = move(brep, near);
  slide(brep, moved);
  collapse(brep, moved, near);
  if (!take_back(brep, moved)) {
    brep = before;  // a vertex merged with another may have no valid position on the chords: repeat without merging
    moved = move(brep, near);
    take_back(brep, moved);
  }
  if (std::any_of(chords_.begin(), chords_.end(), [](double chord) { return chord > 0.0; })) { merge_points(brep, 0.25 * near); }
}

HALFLIGHT_INLINE CsgPlacement::Moved CsgPlacement::move(CsgBRep& brep, double near) const {
  Moved moved{std::vector<glm::dvec3>(brep.vertex_end(), glm::dvec3(0.0)), std::vector<double>(brep.vertex_end(), 0.0)};
  for (const brep::VertexId v : brep::vertices(brep)) {
    const std::vector<std::uint32_t> sheets = sheets_of(brep, v);
    double chord = 0.0;
    for (const std::uint32_t s : sheets) {
      if (!tree_.flat_sheet(s)) { chord = std::max(chord, chords_[tree_.leaf_of(s)]); }
    }
    const glm::dvec3 start = moved.chord[v.index] = brep.data(v).position;
    const glm::dvec3 after = onto(sheets, start);
    const double reach = (chord > 0.0 ? 2 * chord / sine(sheets, after) : 0.0) + near;
    if (!(glm::length(after - start) <= reach)) { continue; }
    brep.data(v).position = after;
    if (chord > 0.0) { moved.slides[v.index] = 3 * reach; }
  }
  return moved;
}

HALFLIGHT_INLINE bool CsgPlacement::take_back(CsgBRep& brep, const Moved& moved) const {
  const auto off = [&](brep::VertexId v) { return brep.data(v).position != moved.chord[v.index]; };
  std::vector<brep::FaceId> look, next;
  for (const brep::FaceId f : brep::faces(brep)) { look.push_back(f); }
  bool sound = true;
  while (!look.empty()) {
    next.clear();
    for (const brep::FaceId f : look) {
      if (is_sound(brep, f)) { continue; }
      std::vector<brep::VertexId> back, all;
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
        const brep::VertexId v = brep.vertex(h);
        if (!off(v)) { continue; }
        all.push_back(v);
        if (!back.empty()) { continue; }
        const glm::dvec3 there = std::exchange(brep.data(v).position, moved.chord[v.index]);
        if (is_sound(brep, f)) { back.push_back(v); }
        brep.data(v).position = there;
      }
      if (all.empty()) { sound = false; }
      for (const brep::VertexId v : back.empty() ? all : back) {
        brep.data(v).position = moved.chord[v.index];
        for (const brep::HalfedgeId h : brep::halfedges_from(brep, v)) { next.push_back(brep.face(h)); }
      }
    }
    unique(next);
    std::swap(look, next);
  }
  return sound;
}

HALFLIGHT_INLINE void CsgPlacement::slide(CsgBRep& brep, const Moved& moved) const {
  std::vector<brep::FaceId> look;
  for (const brep::VertexId v : brep::vertices(brep)) {
    if (moved.slides[v.index] == 0.0) { continue; }
    for (const brep::HalfedgeId h : brep::halfedges_from(brep, v)) { look.push_back(brep.face(h)); }
  }
  std::vector<brep::VertexId> vertices;
  unique(look);
  for (int round = 0; round < 40 && !look.empty(); ++round) {
    vertices.clear();
    for (const brep::FaceId f : look) {
      if (is_sound(brep, f)) { continue; }
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
        if (moved.slides[brep.vertex(h).index] > 0.0) { vertices.push_back(brep.vertex(h)); }
      }
    }
    unique(vertices);
    look.clear();
    for (const brep::VertexId v : vertices) {
      const std::vector<std::uint32_t> sheets = sheets_of(brep, v);
      glm::dvec3 sum(0.0);
      int count = 0;
      for (const brep::HalfedgeId h : brep::halfedges_from(brep, v)) {
        look.push_back(brep.face(h));
        const bool along = brep.data(brep.face(h)).sheet != brep.data(brep.face(brep::twin(h))).sheet;
        if (sheets.size() > 1 && !along) { continue; }
        sum += brep.data(brep.target(h)).position;
        ++count;
      }
      if (sheets.size() > 1 && count != 2) {
        continue;  // two or more curves meet here
      }
      const glm::dvec3 p = onto(sheets, 0.5 * brep.data(v).position + 0.5 / count * sum);
      if (glm::length(p - moved.chord[v.index]) <= moved.slides[v.index]) { brep.data(v).position = p; }
    }
    unique(look);
  }
}

HALFLIGHT_INLINE void CsgPlacement::collapse(CsgBRep& brep, const Moved& moved, double near) const {
  for (bool again = true; again;) {  // every round removes at least one vertex
    again = false;
    std::vector<brep::FaceId> turned;
    for (const brep::FaceId f : brep::faces(brep)) {
      if (!is_sound(brep, f)) { turned.push_back(f); }
    }
    for (const brep::FaceId f : turned) {
      if (!brep.alive(f)) { continue; }
      std::vector<std::pair<double, brep::HalfedgeId>> edges;
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
        const double length = glm::length(brep.data(brep.target(h)).position - brep.data(brep.vertex(h)).position);
        if (length > 0.7 * std::max(moved.slides[brep.vertex(h).index], moved.slides[brep.target(h).index]) + near) { continue; }
        edges.push_back({length, h});
        edges.push_back({length, brep::twin(h)});
      }
      std::sort(edges.begin(), edges.end());
      const auto found = std::find_if(edges.begin(), edges.end(), [&](const auto& edge) {
        return moved.slides[brep.vertex(edge.second).index] > 0.0 && may_shrink(brep, edge.second);
      });
      if (found == edges.end()) { continue; }
      shrink(brep, found->second);
      again = true;
    }
  }
}

HALFLIGHT_INLINE void CsgPlacement::merge_points(CsgBRep& brep, double near) const {
  for (bool again = true; again;) {
    again = false;
    std::vector<brep::HalfedgeId> close;
    for (const brep::EdgeId e : brep::edges(brep)) {
      const brep::HalfedgeId h = brep::halfedge(e);
      if (glm::length(brep.data(brep.target(h)).position - brep.data(brep.vertex(h)).position) <= near) { close.push_back(h); }
    }
    for (const brep::HalfedgeId h : close) {
      if (!brep.alive(h)) { continue; }
      if (may_shrink(brep, h, false)) {
        shrink(brep, h);
      } else if (may_shrink(brep, brep::twin(h), false)) {
        shrink(brep, brep::twin(h));
      } else {
        continue;
      }
      again = true;
    }
  }
}

HALFLIGHT_INLINE bool CsgPlacement::may_shrink(const CsgBRep& brep, brep::HalfedgeId h, bool sheets) const {
  const brep::VertexId v = brep.vertex(h), w = brep.target(h);
  const std::vector<std::uint32_t> from = sheets_of(brep, v), to = sheets_of(brep, w);
  if (sheets && !std::includes(to.begin(), to.end(), from.begin(), from.end())) { return false; }
  const brep::HalfedgeId sides[2] = {h, brep::twin(h)};
  if (sheets && from.size() > 1 && brep.data(brep.face(sides[0])).sheet == brep.data(brep.face(sides[1])).sheet) { return false; }
  const auto triangle = [&](brep::HalfedgeId x) { return brep.next(brep.next(brep.next(x))) == x; };
  // Number of triangles at h (each has one corner opposite to it); number of common neighbours of both ends.
  std::size_t across = 0, common = 0;
  for (const brep::HalfedgeId side : sides) {
    if (!triangle(side)) { continue; }
    ++across;
    if (brep::degree(brep, brep.target(brep.next(side))) <= 3) { return false; }
  }
  for (const brep::HalfedgeId x : brep::halfedges_from(brep, v)) {
    for (const brep::HalfedgeId y : brep::halfedges_from(brep, w)) {
      if (brep.target(x) == brep.target(y)) { ++common; }
      if (brep.face(x) == brep.face(y) && brep.face(x) != brep.face(h) && brep.face(x) != brep.face(brep::twin(h))) { return false; }
    }
    if (brep.target(x) == w && x != h) { return false; }
  }
  if (common != across) { return false; }
  std::vector<glm::dvec3> corners;
  for (const brep::HalfedgeId x : brep::halfedges_from(brep, v)) {
    if ((brep.face(x) == brep.face(sides[0]) && triangle(sides[0])) || (brep.face(x) == brep.face(sides[1]) && triangle(sides[1]))) {
      continue;
    }
    corners.clear();
    for (const brep::HalfedgeId y : brep::halfedges_of(brep, brep.face(x))) {
      corners.push_back(brep.data(brep.vertex(y) == v ? w : brep.vertex(y)).position);
    }
    if (!is_sound(corners, brep.data(brep.face(x)).sheet) && (sheets || is_sound(brep, brep.face(x)))) { return false; }
  }
  return true;
}

HALFLIGHT_INLINE void CsgPlacement::shrink(CsgBRep& brep, brep::HalfedgeId h) {
  const brep::HalfedgeId sides[2] = {brep.next(h), brep.next(brep::twin(h))};
  brep::unchecked::join_vertices(brep, brep::twin(h));
  for (const brep::HalfedgeId side : sides) {
    if (brep.next(brep.next(side)) == side) { brep::unchecked::join_faces(brep, brep::twin(side)); }
  }
}

HALFLIGHT_INLINE double CsgPlacement::sine(const std::vector<std::uint32_t>& sheets, const glm::dvec3& p) const {
  double least = 1.0;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      least = std::min(least, glm::length(glm::cross(tree_.project(sheets[i], p).normal, tree_.project(sheets[k], p).normal)));
    }
  }
  return std::max(least, 0.125);
}

HALFLIGHT_INLINE std::vector<std::uint32_t> CsgPlacement::sheets_of(const CsgBRep& brep, brep::VertexId v) {
  std::vector<std::uint32_t> sheets;
  for (const brep::HalfedgeId h : brep::halfedges_from(brep, v)) { sheets.push_back(brep.data(brep.face(h)).sheet); }
  std::sort(sheets.begin(), sheets.end());
  sheets.erase(std::unique(sheets.begin(), sheets.end()), sheets.end());
  return sheets;
}

HALFLIGHT_INLINE glm::dvec3 CsgPlacement::onto(const std::vector<std::uint32_t>& sheets, glm::dvec3 p) const {
  std::vector<SurfacePoint> planes;
  for (int round = 0; round < 8; ++round) {
    const glm::dvec3 before = p;
    planes.clear();
    for (const std::uint32_t s : sheets) { planes.push_back(tree_.project(s, p)); }
    if (round > 0 || planes.size() > 1) { p = towards(p, planes); }
    for (const std::uint32_t s : sheets) { p = tree_.project(s, p).position; }
    if (p == before) { break; }
  }
  return p;
}

HALFLIGHT_INLINE bool CsgPlacement::is_sound(brep::Polygon corners, std::uint32_t sheet) const {
  const glm::dvec3 area = brep::vector_area(corners);
  if (!(glm::dot(area, tree_.project(sheet, corners[0]).normal) > 0.25 * glm::length(area))) { return false; }
  return brep::is_convex(corners) || (corners.size() > 3 && !brep::Outline(corners).self_contact());
}

}  // namespace detail

}  // namespace raycast
