// SPDX-License-Identifier: MIT
#pragma once

// What an operator answers: a value, or a refusal that says why nothing was changed.
//
// Errors are values; nothing here throws. A refusal is a code and up to two handles, so making one costs no allocation;
// the sentence is written when somebody asks for it. Reading the value of a refused result is a programming error
// (asserted in debug builds).

#include <array>
#include <cassert>
#include <cstdint>
#include <string>
#include <utility>

#include <brep/handles.hpp>

namespace brep {

enum class Code : std::uint8_t {
  none,                // not refused
  dead,                // the handle names no living element
  different_faces,     // split_face: the two corners lie on different faces
  different_vertices,  // split_vertex: the two half-edges leave different vertices
  same_face,           // join_faces: both sides of the edge are one face
  same_vertex,         // join_vertices: the edge is a loop
  one_face,            // bridge: both half-edges lie on one face
  two_faces,           // cut: the sides of the edge are different faces
  spur,                // cut: an end of the edge has no other edge
  one_vertex,          // weld: both half-edges leave one vertex
  two_vertices,        // unweld: the edge is no loop
  one_edge_face,       // unweld: a side of the edge is a face with this edge alone
  other_handle,        // replay: the step makes another handle than before
  last_edge,           // the operator would leave a shell without edges
  not_a_segment,       // kill_segment: the shell has more than one edge
  full,                // 2^31 half-edges: no handle is left
  few_corners,         // the face has fewer than three corners
  level_limit,         // refine: level 255 is reached
  irregular_levels,    // refine: no vertex of level l + 1 between two corners although they are not adjacent
  degenerate_polygon,  // zero area or a coordinate that is not finite
  not_planar,          // the vertices do not lie in one plane
  not_simple,          // the boundary crosses or touches itself
  not_on_face,         // a split object answered with a half-edge of another face
  no_progress,         // a split object answered with a cut that leaves a part as it was: equal or adjacent corners
  not_on_edge,         // a split object answered with a point outside its half-edge
  vertex_limit,        // split_recursively: the split objects asked for more new vertices than the limit allows
  link_condition,      // collapse_edge: the ends have a common neighbour that is not the third corner of a triangle
  cannot_flip,         // flip_edge: the sides are one face, or one of them has this edge alone
  equal_faces,         // glue_faces, punch_hole: both half-edges lie on one face
  different_degrees,   // glue_faces, punch_hole: the two faces have different numbers of edges
  outside_grid,        // csg: a vertex does not lie on the grid, or is not finite
  collapsed,           // csg: what remains of a face on the grid has no area, or an edge of it no length
  self_intersecting,   // csg: two faces of one solid have more in common than edges and vertices
  inside_out,          // csg: the shell of a face looks inwards where it must look outwards, or the other way round
  different_grids,     // csg: the operands stand on different grids
};

struct Refusal {
  Code code = Code::none;
  std::array<Element, 2> elements{};

  // One sentence: what was asked, what stands against it, and where it helps, what to do instead.
  [[nodiscard]] std::string sentence() const {
    const std::string x = to_string(elements[0]);
    const std::string y = to_string(elements[1]);
    switch (code) {
      case Code::none:
        return "nothing was refused";
      case Code::dead:
        return x + " does not exist: it was never made or is already killed";
      case Code::different_faces:
        return "split_face: " + x + " and " + y + " lie on different faces";
      case Code::different_vertices:
        return "split_vertex: " + x + " and " + y + " leave different vertices";
      case Code::same_face:
        return "join_faces: both sides of " + x + " are the face " + y + ", there is nothing to join";
      case Code::same_vertex:
        return "join_vertices: " + x + " is a loop, both its ends are the vertex " + y;
      case Code::one_face:
        return "bridge: " + x + " and " + y + " lie on the same face; split_face connects them";
      case Code::two_faces:
        return "cut: the sides of " + x + " are different faces; join_faces removes it";
      case Code::spur:
        return "cut: " + y + " would be left without an edge; join_vertices removes " + x;
      case Code::one_vertex:
        return "weld: " + x + " and " + y + " leave the same vertex; split_vertex puts an edge between them";
      case Code::two_vertices:
        return "unweld: the ends of " + x + " are different vertices; join_vertices contracts it";
      case Code::one_edge_face:
        return "unweld: " + y + " has no edge but " + x + " and would be left without; join_faces removes it";
      case Code::other_handle:
        return "replay: this step made " + x + " before and makes " + y + " now; the BRep is not what the log started from";
      case Code::last_edge:
        return x + " is the only edge of its shell, and a shell without edges does not exist";
      case Code::not_a_segment:
        return "kill_segment: the shell of " + x + " has more than one edge";
      case Code::full:
        return "no handle is left: a BRep holds at most 2^31 half-edges";
      case Code::few_corners:
        return x + " has fewer than three corners";
      case Code::level_limit:
        return "refine: " + x + " has already the last level, 255";
      case Code::irregular_levels:
        return "refine: between the corner " + x + " of " + y + " and the next corner lie vertices, but none of the next level";
      case Code::degenerate_polygon:
        return x + " has no area, or a coordinate that is not finite";
      case Code::not_planar:
        return x + " is not planar";
      case Code::not_simple:
        return "the boundary of " + x + " crosses or touches itself at " + y;
      case Code::not_on_face:
        return "the split object answered with " + x + ", which does not lie on " + y;
      case Code::no_progress:
        return "the split object answered with " + x + " and " + y + ", which are equal or adjacent: such a cut leaves a part as it was";
      case Code::not_on_edge:
        return "the split object answered with a point that is not inside " + x + ": the fraction must be at least 0 and below 1";
      case Code::vertex_limit:
        return "the split object goes on to insert vertices into " + x + ": the limit is reached before the condition holds";
      case Code::link_condition:
        return "collapse_edge: both ends of " + x + " have the neighbour " + y + ", two edges between the same vertices would arise";
      case Code::cannot_flip:
        return "flip_edge: " + x + " does not lie between two faces that have a further edge each: see " + y;
      case Code::equal_faces:
        return x + " and " + y + " lie on the same face, two faces are needed";
      case Code::different_degrees:
        return x + " and " + y + " lie on faces with different numbers of edges";
      case Code::outside_grid:
        return x + " of " + y + " does not lie within the box for which the grid was made, or is not finite";
      case Code::collapsed:
        return x +
               " has no area or an edge without length when its vertices are put on the grid; it needs a larger model or a smaller grid";
      case Code::self_intersecting:
        return x + " and " + y + " meet in more than common edges and vertices: the surface intersects or touches itself there";
      case Code::inside_out:
        return "the shell of " + x + " is inside out: its faces must look away from the solid";
      case Code::different_grids:
        return "the operands stand on different grids: make all leaves of a tree with one grid";
    }
    return {};
  }
};

template <class T>
class Result {
 public:
  Result(T value) : value_(std::move(value)) {}   // implicit: return value;
  Result(Refusal refusal) : refusal_(refusal) {}  // implicit: return Refusal{...};

  [[nodiscard]] bool has_value() const { return refusal_.code == Code::none; }
  explicit operator bool() const { return has_value(); }
  [[nodiscard]] const Refusal& refusal() const { return refusal_; }

  T& operator*() { return assert(has_value()), value_; }
  const T& operator*() const { return assert(has_value()), value_; }
  T* operator->() { return assert(has_value()), &value_; }
  const T* operator->() const { return assert(has_value()), &value_; }

 private:
  T value_{};
  Refusal refusal_{};
};

}  // namespace brep
