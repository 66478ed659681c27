// SPDX-License-Identifier: MIT
#pragma once

// Second step of the cut: the segments are drawn into the faces, and each face falls into its regions.
//
// At a point where segments end, all edges of the face are sorted by direction. A half-edge that arrives goes on with the first one that
// leaves clockwise of the way it came, so the region on its left is kept together: the links that split_face and bridge would make one
// segment after the other. A segment may end inside the face, where an edge of the other operand touches it. Where the operands touch
// themselves, a segment may run through the end of another; it is cut there, too.
//
// Why not by calls of the operators (paper 2.2): faces of a BRep have no rings, so an operator reaches a loop inside a face only by a
// bridge edge. A bridge has no geometry: it lies on no plane of the operands, its ends would have to see each other, and the next loop may
// cross it. Without rings there is nothing to bridge, and links in arrays are what the operators change anyhow. That both come to the same
// map is tested (tests/brep/csg_cut_test.cpp), and shown step by step by examples/euler/090_union.euler. Bridges are drawn once, by the
// operator, where a result becomes a BRep (to_brep.hpp).

#include <cstdint>
#include <vector>

#include <brep/csg/contacts.hpp>
#include <brep/csg/directions.hpp>
#include <brep/csg/regions.hpp>
#include <brep/csg/split_edges.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>

namespace brep::csg::detail {

class CutFaces {
 public:
  explicit CutFaces(Work& work) : work_(work), regions_(work) {}

  std::vector<std::uint32_t>
      cuts;  // the lower half-edge of each new edge; its twin, with the same face on both sides at first, is next to it
  std::vector<std::uint32_t> touched;   // faces with a segment or a split edge, before they fall into pieces
  std::uint32_t fault = invalid_index;  // a face that is not bounded as a face must be, if there is one

  void run(std::vector<Segment>& segments, const SplitEdges& edges, const std::vector<std::uint32_t>& contacts);

 private:
  struct Spoke {
    std::uint32_t point;
    std::uint32_t in, out;  // half-edges that arrive and leave along it
    Direction direction;
  };

  static void remove_copies(std::vector<Segment>& segments);

  // Cuts segments at the points of contact inside them, which lie there only where an operand touches itself.
  bool split_at_contacts(std::vector<Segment>& segments, std::vector<std::uint32_t> points) const;
  [[nodiscard]] int widest(const std::vector<std::uint32_t>& points) const;
  [[nodiscard]] bool between(std::uint32_t p, const Segment& s) const;

  void cut(std::uint32_t f, const Segment* segment, const Segment* end);

  // Adds the segments as edges and links the half-edges at their ends anew.
  void draw(std::uint32_t f, const Segment* segment, const Segment* end);

  Work& work_;
  Regions regions_;
  std::vector<std::uint32_t> stamp_, halves_;
  std::vector<Spoke> spokes_;
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/cut_faces.cpp>
#endif
