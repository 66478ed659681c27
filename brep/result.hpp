// SPDX-License-Identifier: MIT
#pragma once

// What an operator answers: a value, or a refusal that says why nothing was changed.
//
// Errors are values; nothing here throws. A refusal is a code and up to two handles, so making one costs no allocation;
// the sentence is written when somebody asks for it. Reading the value of a refused result is a programming error
// (asserted in debug builds).

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
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

// What each refusal says: what was asked, what stands against it, and where it helps, what to do instead. %x and %y are its elements.
inline constexpr std::pair<Code, std::string_view> refusal_sentences[] = {
    {Code::none, "nothing was refused"},
    {Code::dead, "%x does not exist: it was never made or is already killed"},
    {Code::different_faces, "split_face: %x and %y lie on different faces"},
    {Code::different_vertices, "split_vertex: %x and %y leave different vertices"},
    {Code::same_face, "join_faces: both sides of %x are the face %y, there is nothing to join"},
    {Code::same_vertex, "join_vertices: %x is a loop, both its ends are the vertex %y"},
    {Code::one_face, "bridge: %x and %y lie on the same face; split_face connects them"},
    {Code::two_faces, "cut: the sides of %x are different faces; join_faces removes it"},
    {Code::spur, "cut: %y would be left without an edge; join_vertices removes %x, kill_segment where it is the only edge of its shell"},
    {Code::one_vertex, "weld: %x and %y leave the same vertex; split_vertex puts an edge between them"},
    {Code::two_vertices,
     "unweld: the ends of %x are different vertices; join_vertices contracts it, unless it is the only edge of its shell"},
    {Code::one_edge_face, "unweld: %y has no edge but %x and would be left without; join_faces removes it"},
    {Code::other_handle, "replay: this step made %x before and makes %y now; the BRep is not what the log started from"},
    {Code::last_edge, "%x is the only edge of its shell, and a shell without edges does not exist; kill_segment removes both"},
    {Code::not_a_segment, "kill_segment: the shell of %x has more than one edge"},
    {Code::full, "no handle is left: a BRep holds at most 2^31 half-edges"},
    {Code::few_corners, "%x has fewer than three corners"},
    {Code::level_limit, "refine: %x has already the last level, 255"},
    {Code::irregular_levels, "refine: between the corner %x of %y and the next corner lie vertices, but none of the next level"},
    {Code::degenerate_polygon, "%x has no area, or a coordinate that is not finite"},
    {Code::not_planar, "%x is not planar"},
    {Code::not_simple, "the boundary of %x crosses or touches itself at %y"},
    {Code::not_on_face, "the split object answered with %x, which does not lie on %y"},
    {Code::no_progress, "the split object answered with %x and %y, which are equal or adjacent: such a cut leaves a part as it was"},
    {Code::not_on_edge, "the split object answered with a point that is not inside %x: the fraction must be at least 0 and below 1"},
    {Code::vertex_limit, "the split object goes on to insert vertices into %x: the limit is reached before the condition holds"},
    {Code::link_condition, "collapse_edge: both ends of %x have the neighbour %y, two edges between the same vertices would arise"},
    {Code::cannot_flip, "flip_edge: %x does not lie between two faces that have a further edge each: see %y"},
    {Code::equal_faces, "%x and %y lie on the same face, two faces are needed"},
    {Code::different_degrees, "%x and %y lie on faces with different numbers of edges"},
    {Code::outside_grid, "%x of %y does not lie within the box for which the grid was made, or is not finite"},
    {Code::collapsed,
     "%x has no area or an edge without length when its vertices are put on the grid; it needs a larger model or a smaller grid"},
    {Code::self_intersecting, "%x and %y meet in more than common edges and vertices: the surface intersects or touches itself there"},
    {Code::inside_out, "the shell of %x is inside out: its faces must look away from the solid"},
    {Code::different_grids, "the operands stand on different grids: make all leaves of a tree with one grid"},
};

struct Refusal {
  Code code = Code::none;
  std::array<Element, 2> elements{};

  [[nodiscard]] std::string sentence() const {
    const auto* const row =
        std::find_if(std::begin(refusal_sentences), std::end(refusal_sentences), [&](const auto& r) { return r.first == code; });
    if (row == std::end(refusal_sentences)) { return {}; }
    std::string text{row->second};
    for (const auto& [name, element] : {std::pair{"%x", elements[0]}, std::pair{"%y", elements[1]}}) {
      const std::size_t at = text.find(name);
      if (at != std::string::npos) { text.replace(at, 2, to_string(element)); }
    }
    return text;
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
