// SPDX-License-Identifier: MIT
#pragma once

// Where two faces meet: the common part of their two intervals on the line of their planes (paper 2.2: "faces ... are intersected").
//
// A face meets the line in points of its boundary, between which the line runs inside the face, outside, or along an edge of it. To know
// which, walk along the line with two bits, "inside just to the left" and "inside just to the right": an edge that reaches the line from a
// side turns the bit of that side. Both bits: inside; one bit: along an edge. The walks of both faces together give the common
// segments, cut at every point of either boundary, and all common points. Faces in one plane are not compared: where their
// borders meet, the faces on the other sides of these borders lie in other planes and find the common points.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/point_table.hpp>
#include <brep/csg/work.hpp>

namespace brep::csg::detail {

struct Segment {
  std::uint32_t face;  // which it cuts
  std::uint32_t from, to;
  PlaneNumber across;
};
struct EdgeNode {
  std::uint32_t edge;  // the lower half-edge
  std::uint32_t point;
};

class Contacts {
 public:
  explicit Contacts(Work& work) : table(work), work_(work) {}

  PointTable table;
  std::vector<Segment> segments;  // inside of faces
  std::vector<EdgeNode> nodes;    // inside of edges
  std::vector<std::uint32_t>
      along;               // lower half-edges of edges that run along a face or an edge of the other operand, perhaps several times
  bool consistent = true;  // false: a face is not bounded as a face must be

  // Compares the faces f and g of the two operands.
  void compare(std::uint32_t f, std::uint32_t g) {
    if (!meet(f, g)) { return; }
    walk(f, g);
  }

 protected:
  struct Event {
    Point point;
    std::uint32_t half;
    std::uint8_t of_g, vertex, turn;  // turn: bit 0 left, bit 1 right
    std::uint32_t group;
  };
  struct Along {
    std::uint32_t half, first, last;  // groups
    bool of_g;
  };

  // Fills events_ and along_ and sorts them into groups of equal points. False: no common point.
  bool meet(std::uint32_t f, std::uint32_t g);

  // On which side of the plane the half-edges of the face start; false: all on one side of it.
  bool sides(const WorkFace& f, PlaneNumber q, std::vector<std::int8_t>& result) const;

  void collect(const WorkFace& f, PlaneNumber q, const std::vector<std::int8_t>& side, bool of_g);

  void walk(std::uint32_t f, std::uint32_t g);

  // The number of the common point of group k, noted on the edges in whose inside it lies.
  std::uint32_t resolve(std::uint32_t k);

  // Notes the edges that the face has between the groups k - 1 and k; false: none.
  bool run_along(std::uint32_t k, bool of_g);

  [[nodiscard]] std::uint32_t lower(std::uint32_t h) const { return std::min(h, work_.halves[h].twin); }

  Work& work_;
  std::vector<std::int8_t> sides_f_, sides_g_;
  std::vector<Event> events_;
  std::vector<Along> along_;
  std::vector<std::uint32_t> groups_;  // first events, and the end
  int axis_ = 0;
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/contacts.cpp>
#endif
