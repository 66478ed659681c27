// SPDX-License-Identifier: MIT
#pragma once

// One operation on two boundaries, step by step as in the paper (2.2): intersect the faces pairwise, collect the loops of common edges, cut
// along them, label by breadth-first search, select, reglue.
//
// Two operations do for all three: a - b is the intersection of a with b turned inside out. Each step has a file of its own; here is their
// order. Cost: one pass over both operands, and work near the common edges.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <brep/csg/assemble.hpp>
#include <brep/csg/boundary.hpp>
#include <brep/csg/contacts.hpp>
#include <brep/csg/labels.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/point_table.hpp>
#include <brep/csg/radial.hpp>
#include <brep/csg/solid.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>

namespace brep::csg::detail {

// Both operands, cut along each other and labelled.
class Arrangement {
 public:
  Work work;
  Contacts contacts;
  std::vector<std::uint32_t> cuts;
  Radial radial;
  Labels labels;
  std::uint32_t fault = invalid_index;  // a face of the arrangement that no valid operand has, if there is one

  Arrangement(const PlaneTable& planes, const Boundary& a, const Boundary& b, bool reverse_b, std::uint32_t attributes_of_a);
  Arrangement(const Arrangement&) = delete;

 private:
  static Work both(const PlaneTable& planes, const Boundary& a, const Boundary& b, bool reverse_b, std::uint32_t attributes_of_a);

  void find_contacts();

  // What happens to an edge happens to all edges at its place: those whose faces both lie in the plane of a face of the other operand
  // have not been compared with it.
  void add_copies();

  void cut();
};

// The union (or the intersection) of the operands of an arrangement. same(i, j): are the attributes i and j equal?
// False: the operands are not valid.
template <class Same>
[[nodiscard]] bool select(Arrangement& arrangement, bool unite, Same&& same, Boundary& result) {
  if (arrangement.fault != invalid_index) { return false; }
  Work& work = arrangement.work;
  std::vector<std::uint8_t> keep(work.faces.size());
  for (std::size_t f = 0; f < keep.size(); ++f) {
    const Side side = arrangement.labels.sides[f];
    keep[f] = side == Side::on_same ? !work.faces[f].of_b : side == (unite ? Side::outside : Side::inside);
  }
  Assemble assemble(work, std::move(keep));
  if (!assemble.glue(arrangement.radial)) { return false; }
  for (const Spine& s : arrangement.radial.spines) { assemble.merge(s.half, same); }
  for (std::uint32_t c : arrangement.cuts) { assemble.merge(c, same); }
  assemble.straighten([&](std::uint32_t p) { return arrangement.contacts.table.contains(p); });
  result = assemble.run();
  return true;
}

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/operation.cpp>
#endif
