// SPDX-License-Identifier: MIT
#pragma once

// Moves the vertices of a CSG tree's boundary from the grid, and from the chords of the approximations, back onto the true sheets.
//
// A vertex of three planes moves to their common point, which restores the user's coordinates. A vertex between the chords of a curved
// sheet and another sheet moves to the curve in which the two sheets intersect. This may turn over a sliver: chords intersect at slightly
// different points than the surfaces, and two vertices closer together than this difference may swap places. Such vertices slide along
// their curve or surface until no face is turned over, or one of them is merged into the other. If neither helps, the vertices stay on
// the chords.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/polygon.hpp>

#include <raycast/object.hpp>
#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_tree.hpp>

namespace raycast {

namespace detail {

// Moves p the shortest way to the common points of all planes; those after the third independent one are ignored.
glm::dvec3 towards(const glm::dvec3& p, const std::vector<SurfacePoint>& planes);

class CsgPlacement {
 public:
  // `chords`: by leaf of the tree, the largest distance of the faces of its approximation from its sheets.
  CsgPlacement(const CsgTree& tree, const std::vector<double>& chords) : tree_(tree), chords_(chords) {}

  // Faces must be convex and lie on the chords. Each remains simple and keeps the orientation of its sheet. `near`: a vertex of
  // flat sheets moves no farther than this, because only the grid has moved it off them.
  void put_back(CsgBRep& brep, double near) const;

 private:
  struct Moved {
    std::vector<glm::dvec3> chord;  // by vertex: its position before the move
    std::vector<double> slides;     // by vertex: how far from there it may slide; 0: not at all
  };

  Moved move(CsgBRep& brep, double near) const;

  // Moves vertices of invalid faces back to the chords: one vertex if that makes the face valid, else all of its vertices. Returns
  // whether all faces are valid then. Every round moves at least one vertex back, so the loop ends.
  bool take_back(CsgBRep& brep, const Moved& moved) const;

  template <class Id>
  static void unique(std::vector<Id>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  // Vertices of faces that the move has turned over slide on their surface or curve to a place between their neighbours.
  void slide(CsgBRep& brep, const Moved& moved) const;

  // If a face is still turned over, an edge of it as short as the chord error shrinks to a point.
  void collapse(CsgBRep& brep, const Moved& moved, double near) const;

  // Merges vertices whose edge is no longer than a cell of the grid.
  void merge_points(CsgBRep& brep, double near) const;

  // May the origin of h move to its target? Not if this would change the topology, take a vertex off a sheet, or turn a face over. With
  // `sheets` = false it may leave a sheet, and faces that are invalid already may remain so.
  [[nodiscard]] bool may_shrink(const CsgBRep& brep, brep::HalfedgeId h, bool sheets = true) const;

  static void shrink(CsgBRep& brep, brep::HalfedgeId h);

  // The sine of the smallest angle at which two of the sheets meet, at least an eighth. If sheets meet at a small angle, a small chord
  // error moves their common curve far.
  [[nodiscard]] double sine(const std::vector<std::uint32_t>& sheets, const glm::dvec3& p) const;

  [[nodiscard]] static std::vector<std::uint32_t> sheets_of(const CsgBRep& brep, brep::VertexId v);

  [[nodiscard]] glm::dvec3 onto(const std::vector<std::uint32_t>& sheets, glm::dvec3 p) const;

  // Is the face oriented as its sheet, with a boundary that does not touch itself?
  [[nodiscard]] bool is_sound(const CsgBRep& brep, brep::FaceId f) const {
    return is_sound(brep::Polygon(brep::positions(brep, f)), brep.data(f).sheet);
  }
  [[nodiscard]] bool is_sound(brep::Polygon corners, std::uint32_t sheet) const;

  const CsgTree& tree_;
  const std::vector<double>& chords_;
};

}  // namespace detail

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_place.cpp>
#endif
