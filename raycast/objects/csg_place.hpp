// SPDX-License-Identifier: MIT
#pragma once

// Puts the vertices of a CSG tree's boundary back from the grid, and from the chords of the approximations, onto the true sheets.
//
// A vertex of three planes goes to their common point, which restores the coordinates that the user wrote; where chords of a curved sheet
// meet another one the vertex moves to the curve in which the two sheets themselves meet. That may turn over a sliver: chords cross each
// other not quite where the surfaces do, and two vertices that lie closer together than that change places. Such vertices slide along their
// curve or surface until nothing is turned over, or one of them goes into the other. What neither mends stays on the chords.

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

// Moves p towards all planes at once: the shortest way to their common points; those beyond the third independent one are left out.
glm::dvec3 towards(const glm::dvec3& p, const std::vector<SurfacePoint>& planes);

class CsgPlacement {
 public:
  // `chords`: of each leaf of the tree, how far the faces of its approximation are off its sheets at most.
  CsgPlacement(const CsgTree& tree, const std::vector<double>& chords) : tree_(tree), chords_(chords) {}

  // Faces must be convex and lie on the chords. Each stays simple and looks the way that its sheet looks.
  // `near`: a vertex of flat sheets is moved no farther, because it is off them only by the grid.
  void put_back(CsgBRep& brep, double near) const;

 private:
  struct Moved {
    std::vector<glm::dvec3> chord;  // of each vertex: where it was
    std::vector<double> slides;     // how far from there it may slide; 0: not at all
  };

  Moved move(CsgBRep& brep, double near) const;

  // Puts vertices of faces that are not sound back on the chords: one, if that mends the face, else all of it. Are all faces sound then?
  // Every round takes at least one vertex back, so this ends.
  bool take_back(CsgBRep& brep, const Moved& moved) const;

  template <class Id>
  static void unique(std::vector<Id>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  // Chords cross each other where the true surfaces do not quite: put back, the ends of a sliver may change places and turn it over. Such
  // vertices slide on their surface or curve to between their neighbours.
  void slide(CsgBRep& brep, const Moved& moved) const;

  // Where a face is turned over still, one of its edges is as short as the chords are inexact: it shrinks to a point.
  void collapse(CsgBRep& brep, const Moved& moved, double near) const;

  // Vertices that are a cell of the grid apart, or less, are one point.
  void merge_points(CsgBRep& brep, double near) const;

  // May the vertex where h starts move into the one where it ends? Not if that changed the topology, left a sheet, or turned a face over.
  // `sheets`: it may not leave a sheet, nor keep faces that are not sound as they are.
  [[nodiscard]] bool may_shrink(const CsgBRep& brep, brep::HalfedgeId h, bool sheets = true) const;

  static void shrink(CsgBRep& brep, brep::HalfedgeId h);

  // Of the smallest angle at which two of the sheets meet, no less than an eighth: where they graze each other, a small error of the chords
  // moves their common curve far.
  [[nodiscard]] double sine(const std::vector<std::uint32_t>& sheets, const glm::dvec3& p) const;

  [[nodiscard]] static std::vector<std::uint32_t> sheets_of(const CsgBRep& brep, brep::VertexId v);

  [[nodiscard]] glm::dvec3 onto(const std::vector<std::uint32_t>& sheets, glm::dvec3 p) const;

  // Does the face look to the side that its sheet looks to, with a boundary that does not meet itself?
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
