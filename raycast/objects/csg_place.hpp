// SPDX-License-Identifier: MIT
#pragma once

// Puts the vertices of a CSG tree's boundary back from the grid, and from the chords of the approximations, onto the true sheets.
//
// A vertex of three planes goes to their common point, which restores the coordinates that the user wrote; where chords of a curved sheet
// meet another one the vertex moves to the curve in which the two sheets themselves meet. That may turn over a sliver: chords cross each
// other not quite where the surfaces do, and two vertices that lie closer together than that change places. Such vertices slide along their
// curve or surface until nothing is turned over, or one of them goes into the other. What neither mends stays on the chords.

#include <algorithm>
#include <utility>
#include <vector>

#include <brep/geometry.hpp>
#include <brep/outline.hpp>
#include <brep/unchecked.hpp>

#include "csg_leaf.hpp"

namespace raycast {

namespace detail {

// Moves p towards all planes at once: the shortest way to their common points; those beyond the third independent one are left out.
inline glm::dvec3 towards(const glm::dvec3& p, const std::vector<SurfacePoint>& planes) {
  glm::dvec3 axis[3], way(0.0);
  int count = 0;
  for (const SurfacePoint& plane : planes) {
    glm::dvec3 n = plane.normal;
    for (int i = 0; i < count; ++i) n -= glm::dot(n, axis[i]) * axis[i];
    const double length = glm::length(n);
    if (!(length > 1e-3)) continue;  // nearly parallel to what is there: its position along them is not known
    axis[count] = n / length;
    way += (glm::dot(plane.normal, plane.position - p - way) / length) * axis[count];
    if (++count == 3) break;
  }
  return p + way;
}

class CsgPlacement {
 public:
  // `chords`: of each leaf of the tree, how far the faces of its approximation are off its sheets at most.
  CsgPlacement(const CsgTree& tree, const std::vector<double>& chords) : tree_(tree), chords_(chords) {}

  // Faces must be convex and lie on the chords. Each stays simple and looks the way that its sheet looks.
  // `near`: a vertex of flat sheets is moved no farther, because it is off them only by the grid.
  void put_back(CsgBRep& brep, double near) const {
    const CsgBRep before = brep;
    Moved moved = move(brep, near);
    slide(brep, moved);
    collapse(brep, moved, near);
    if (!take_back(brep, moved)) {
      brep = before;  // a vertex that took in another may not have a place on the chords: without such
      moved = move(brep, near);
      take_back(brep, moved);
    }
    if (std::any_of(chords_.begin(), chords_.end(), [](double chord) { return chord > 0.0; })) merge_points(brep, 0.25 * near);
  }

 private:
  struct Moved {
    std::vector<glm::dvec3> chord;  // of each vertex: where it was
    std::vector<double> slides;     // how far from there it may slide; 0: not at all
  };

  Moved move(CsgBRep& brep, double near) const {
    Moved moved{std::vector<glm::dvec3>(brep.vertex_end(), glm::dvec3(0.0)), std::vector<double>(brep.vertex_end(), 0.0)};
    for (const brep::VertexId v : brep::vertices(brep)) {
      const std::vector<std::uint32_t> sheets = sheets_of(brep, v);
      double chord = 0.0;
      for (const std::uint32_t s : sheets)
        if (!tree_.flat_sheet(s)) chord = std::max(chord, chords_[tree_.leaf_of(s)]);
      const glm::dvec3 start = moved.chord[v.index] = brep.data(v).position;
      const glm::dvec3 after = onto(sheets, start);
      const double reach = (chord > 0.0 ? 2 * chord / sine(sheets, after) : 0.0) + near;
      if (!(glm::length(after - start) <= reach)) continue;
      brep.data(v).position = after;
      if (chord > 0.0) moved.slides[v.index] = 3 * reach;
    }
    return moved;
  }

  // Puts vertices of faces that are not sound back on the chords: one, if that mends the face, else all of it. Are all faces sound then?
  // Every round takes at least one vertex back, so this ends.
  bool take_back(CsgBRep& brep, const Moved& moved) const {
    const auto off = [&](brep::VertexId v) { return brep.data(v).position != moved.chord[v.index]; };
    std::vector<brep::FaceId> look, next;
    for (const brep::FaceId f : brep::faces(brep)) look.push_back(f);
    bool sound = true;
    while (!look.empty()) {
      next.clear();
      for (const brep::FaceId f : look) {
        if (is_sound(brep, f)) continue;
        std::vector<brep::VertexId> back, all;
        for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
          const brep::VertexId v = brep.vertex(h);
          if (!off(v)) continue;
          all.push_back(v);
          if (!back.empty()) continue;
          const glm::dvec3 there = std::exchange(brep.data(v).position, moved.chord[v.index]);
          if (is_sound(brep, f)) back.push_back(v);
          brep.data(v).position = there;
        }
        if (all.empty()) sound = false;
        for (const brep::VertexId v : back.empty() ? all : back) {
          brep.data(v).position = moved.chord[v.index];
          for (const brep::HalfedgeId h : brep::halfedges_from(brep, v)) next.push_back(brep.face(h));
        }
      }
      unique(next);
      std::swap(look, next);
    }
    return sound;
  }

  template <class Id>
  static void unique(std::vector<Id>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  // Chords cross each other where the true surfaces do not quite: put back, the ends of a sliver may change places and turn it over. Such
  // vertices slide on their surface or curve to between their neighbours.
  void slide(CsgBRep& brep, const Moved& moved) const {
    std::vector<brep::FaceId> look;
    for (const brep::VertexId v : brep::vertices(brep)) {
      if (moved.slides[v.index] == 0.0) continue;
      for (const brep::HalfedgeId h : brep::halfedges_from(brep, v)) look.push_back(brep.face(h));
    }
    std::vector<brep::VertexId> vertices;
    unique(look);
    for (int round = 0; round < 40 && !look.empty(); ++round) {
      vertices.clear();
      for (const brep::FaceId f : look) {
        if (is_sound(brep, f)) continue;
        for (const brep::HalfedgeId h : brep::halfedges_of(brep, f))
          if (moved.slides[brep.vertex(h).index] > 0.0) vertices.push_back(brep.vertex(h));
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
          if (sheets.size() > 1 && !along) continue;
          sum += brep.data(brep.target(h)).position;
          ++count;
        }
        if (sheets.size() > 1 && count != 2) continue;  // curves meet here
        const glm::dvec3 p = onto(sheets, 0.5 * brep.data(v).position + 0.5 / count * sum);
        if (glm::length(p - moved.chord[v.index]) <= moved.slides[v.index]) brep.data(v).position = p;
      }
      unique(look);
    }
  }

  // Where a face is turned over still, one of its edges is as short as the chords are inexact: it shrinks to a point.
  void collapse(CsgBRep& brep, const Moved& moved, double near) const {
    for (bool again = true; again;) {  // every round takes at least one vertex away
      again = false;
      std::vector<brep::FaceId> turned;
      for (const brep::FaceId f : brep::faces(brep))
        if (!is_sound(brep, f)) turned.push_back(f);
      for (const brep::FaceId f : turned) {
        if (!brep.alive(f)) continue;
        std::vector<std::pair<double, brep::HalfedgeId>> edges;
        for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
          const double length = glm::length(brep.data(brep.target(h)).position - brep.data(brep.vertex(h)).position);
          if (length > 0.7 * std::max(moved.slides[brep.vertex(h).index], moved.slides[brep.target(h).index]) + near) continue;
          edges.push_back({length, h});
          edges.push_back({length, brep::twin(h)});
        }
        std::sort(edges.begin(), edges.end());
        const auto found = std::find_if(edges.begin(), edges.end(), [&](const auto& edge) {
          return moved.slides[brep.vertex(edge.second).index] > 0.0 && may_shrink(brep, edge.second);
        });
        if (found == edges.end()) continue;
        shrink(brep, found->second);
        again = true;
      }
    }
  }

  // Vertices that are a cell of the grid apart, or less, are one point.
  void merge_points(CsgBRep& brep, double near) const {
    for (bool again = true; again;) {
      again = false;
      std::vector<brep::HalfedgeId> close;
      for (const brep::EdgeId e : brep::edges(brep)) {
        const brep::HalfedgeId h = brep::halfedge(e);
        if (glm::length(brep.data(brep.target(h)).position - brep.data(brep.vertex(h)).position) <= near) close.push_back(h);
      }
      for (const brep::HalfedgeId h : close) {
        if (!brep.alive(h)) continue;
        if (may_shrink(brep, h, false))
          shrink(brep, h);
        else if (may_shrink(brep, brep::twin(h), false))
          shrink(brep, brep::twin(h));
        else
          continue;
        again = true;
      }
    }
  }

  // May the vertex where h starts move into the one where it ends? Not if that changed the topology, left a sheet, or turned a face over.
  // `sheets`: it may not leave a sheet, nor keep faces that are not sound as they are.
  [[nodiscard]] bool may_shrink(const CsgBRep& brep, brep::HalfedgeId h, bool sheets = true) const {
    const brep::VertexId v = brep.vertex(h), w = brep.target(h);
    const std::vector<std::uint32_t> from = sheets_of(brep, v), to = sheets_of(brep, w);
    if (sheets && !std::includes(to.begin(), to.end(), from.begin(), from.end())) return false;
    const brep::HalfedgeId sides[2] = {h, brep::twin(h)};
    if (sheets && from.size() > 1 && brep.data(brep.face(sides[0])).sheet == brep.data(brep.face(sides[1])).sheet) return false;
    const auto triangle = [&](brep::HalfedgeId x) { return brep.next(brep.next(brep.next(x))) == x; };
    std::size_t across = 0, common = 0;  // corners that both triangles at h have across of it; neighbours of both ends
    for (const brep::HalfedgeId side : sides) {
      if (!triangle(side)) continue;
      ++across;
      if (brep::degree(brep, brep.target(brep.next(side))) <= 3) return false;
    }
    for (const brep::HalfedgeId x : brep::halfedges_from(brep, v)) {
      for (const brep::HalfedgeId y : brep::halfedges_from(brep, w)) {
        if (brep.target(x) == brep.target(y)) ++common;
        if (brep.face(x) == brep.face(y) && brep.face(x) != brep.face(h) && brep.face(x) != brep.face(brep::twin(h))) return false;
      }
      if (brep.target(x) == w && x != h) return false;
    }
    if (common != across) return false;
    std::vector<glm::dvec3> corners;
    for (const brep::HalfedgeId x : brep::halfedges_from(brep, v)) {
      if ((brep.face(x) == brep.face(sides[0]) && triangle(sides[0])) || (brep.face(x) == brep.face(sides[1]) && triangle(sides[1])))
        continue;
      corners.clear();
      for (const brep::HalfedgeId y : brep::halfedges_of(brep, brep.face(x)))
        corners.push_back(brep.data(brep.vertex(y) == v ? w : brep.vertex(y)).position);
      if (!is_sound(corners, brep.data(brep.face(x)).sheet) && (sheets || is_sound(brep, brep.face(x)))) return false;
    }
    return true;
  }

  static void shrink(CsgBRep& brep, brep::HalfedgeId h) {
    const brep::HalfedgeId sides[2] = {brep.next(h), brep.next(brep::twin(h))};
    brep::unchecked::join_vertices(brep, brep::twin(h));
    for (const brep::HalfedgeId side : sides)
      if (brep.next(brep.next(side)) == side) brep::unchecked::join_faces(brep, brep::twin(side));
  }

  // Of the smallest angle at which two of the sheets meet, no less than an eighth: where they graze each other, a small error of the chords
  // moves their common curve far.
  [[nodiscard]] double sine(const std::vector<std::uint32_t>& sheets, const glm::dvec3& p) const {
    double least = 1.0;
    for (std::size_t i = 0; i < sheets.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        least = std::min(least, glm::length(glm::cross(tree_.project(sheets[i], p).normal, tree_.project(sheets[k], p).normal)));
    return std::max(least, 0.125);
  }

  [[nodiscard]] static std::vector<std::uint32_t> sheets_of(const CsgBRep& brep, brep::VertexId v) {
    std::vector<std::uint32_t> sheets;
    for (const brep::HalfedgeId h : brep::halfedges_from(brep, v)) sheets.push_back(brep.data(brep.face(h)).sheet);
    std::sort(sheets.begin(), sheets.end());
    sheets.erase(std::unique(sheets.begin(), sheets.end()), sheets.end());
    return sheets;
  }

  [[nodiscard]] glm::dvec3 onto(const std::vector<std::uint32_t>& sheets, glm::dvec3 p) const {
    std::vector<SurfacePoint> planes;
    for (int round = 0; round < 8; ++round) {
      const glm::dvec3 before = p;
      planes.clear();
      for (const std::uint32_t s : sheets) planes.push_back(tree_.project(s, p));
      if (round > 0 || planes.size() > 1) p = towards(p, planes);
      for (const std::uint32_t s : sheets) p = tree_.project(s, p).position;
      if (p == before) break;
    }
    return p;
  }

  // Does the face look to the side that its sheet looks to, with a boundary that does not meet itself?
  [[nodiscard]] bool is_sound(const CsgBRep& brep, brep::FaceId f) const {
    return is_sound(brep::Polygon(brep::positions(brep, f)), brep.data(f).sheet);
  }
  [[nodiscard]] bool is_sound(brep::Polygon corners, std::uint32_t sheet) const {
    const glm::dvec3 area = brep::vector_area(corners);
    if (!(glm::dot(area, tree_.project(sheet, corners[0]).normal) > 0.25 * glm::length(area))) return false;
    return brep::is_convex(corners) || (corners.size() > 3 && !brep::Outline(corners).self_contact());
  }

  const CsgTree& tree_;
  const std::vector<double>& chords_;
};

}  // namespace detail

}  // namespace raycast
