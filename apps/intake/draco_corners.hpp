// SPDX-License-Identifier: MIT
#pragma once

// Corners of triangles, as Draco walks them. Corner c belongs to the triangle c / 3; opposite to it lies the edge between next(c) and
// previous(c), and opposite(c) is the corner that sees the same edge from the other side.
//
//            c
//           / .
//          /   .              swing_right(c) and swing_left(c): the corner of the neighbouring triangle at the same vertex;
//    next *-----* previous    no_corner beyond a boundary.
//          .   /
//           . /
//        opposite(c)

#include <cstdint>
#include <vector>

namespace apps::intake::draco {

inline constexpr std::uint32_t no_corner = ~std::uint32_t{0};

[[nodiscard]] constexpr std::uint32_t next(std::uint32_t c) { return c == no_corner ? c : c % 3 == 2 ? c - 2 : c + 1; }
[[nodiscard]] constexpr std::uint32_t previous(std::uint32_t c) { return c == no_corner ? c : c % 3 == 0 ? c + 2 : c - 1; }

// Positions have one table. An attribute with seams has its own, whose seams are boundaries, so that a vertex has one value in each table.
struct CornerTable {
  std::vector<std::uint32_t> opposite;  // of each corner; an involution: opposite[opposite[c]] == c
  std::vector<std::uint32_t> vertex;    // of each corner
  std::vector<std::uint32_t> leftmost;  // of each vertex: the corner from which swing_right() reaches all others

  [[nodiscard]] std::uint32_t across(std::uint32_t c) const { return c == no_corner ? c : opposite[c]; }
  [[nodiscard]] std::uint32_t swing_left(std::uint32_t c) const { return next(across(next(c))); }
  [[nodiscard]] std::uint32_t swing_right(std::uint32_t c) const { return previous(across(previous(c))); }
  [[nodiscard]] bool on_boundary(std::uint32_t v) const { return swing_left(leftmost[v]) == no_corner; }

  // Numbers the vertices: the corners that swinging connects are one vertex. No walk is endless, because swing_left() and swing_right()
  // undo each other: a walk ends at a boundary or where it began.
  void find_vertices() {
    vertex.assign(opposite.size(), no_corner);
    leftmost.clear();
    for (std::uint32_t c = 0; c < opposite.size(); ++c) {
      if (vertex[c] != no_corner) { continue; }
      std::uint32_t first = c;
      for (std::uint32_t left = swing_left(c); left != no_corner && left != c; left = swing_left(left)) { first = left; }
      const auto v = static_cast<std::uint32_t>(leftmost.size());
      leftmost.push_back(first);
      for (std::uint32_t at = first; at != no_corner && vertex[at] == no_corner; at = swing_right(at)) { vertex[at] = v; }
    }
  }
};

// The order in which the values of the vertices are stored: an entry is a value in this order.
struct Sequence {
  std::vector<std::uint32_t> corner_of_entry, entry_of_vertex;
};

// Visits all triangles depth first or, if `by_degree`, first those whose third vertex has most known neighbours (specification,
// EdgeBreaker Traversal; Cohen-Or et al. 2002 for the degree).
[[nodiscard]] Sequence traverse(const CornerTable& table, bool by_degree);

}  // namespace apps::intake::draco
