// SPDX-License-Identifier: MIT
#pragma once

// Where each face lies with respect to the other operand: breadth-first search over the faces, from the common edges (paper 2.2, last
// sentence).
//
// A label spreads over every edge that is not common to both operands. For a part without a common edge one of its points is tested
// (point_in_solid.hpp): a vertex that does not touch the other operand, or the middle of an edge.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/csg/point_table.hpp>
#include <brep/csg/radial.hpp>
#include <brep/csg/solid.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>

namespace brep::csg::detail {

class Labels {
 public:
  Labels(const Work& work, const PointTable& contacts, bool b_reversed) : work_(work), contacts_(contacts), b_reversed_(b_reversed) {}

  std::vector<Side> sides;              // of each face
  std::uint32_t fault = invalid_index;  // a face with two labels, or none, if there is one

  void run(const Radial& radial);

 private:
  void give(std::uint32_t f, Side side);
  void spread();

  // A point at infinity.
  [[nodiscard]] Side far(bool of_b) const { return of_b && b_reversed_ ? Side::inside : Side::outside; }

  // The faces that hang together with f and have no label.
  [[nodiscard]] Side ask(std::uint32_t f);

  const Work& work_;
  const PointTable& contacts_;
  bool b_reversed_;
  std::vector<std::uint8_t> known_, common_;
  std::vector<std::uint32_t> waiting_;  // the faces in the order in which they got their labels
  std::size_t next_ = 0;                // the first whose neighbours have none from it
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/labels.cpp>
#endif
