// SPDX-License-Identifier: MIT
#pragma once

// First step of the cut: every edge is split at the points of contact inside it, on both its faces.
//
// A split edge keeps its half-edges h and t as the first parts; the further parts lie in memory behind one another in the order in which
// they are walked. The second part of h is the twin of the last but one of t, and so on.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <brep/csg/contacts.hpp>
#include <brep/csg/work.hpp>

namespace brep::csg::detail {

// The edge had the half-edges `edge` and `twin`; each of them has `count` further parts now.
struct EdgeParts {
  std::uint32_t edge, twin, rest, rest_of_twin, count;
};

class SplitEdges {
 public:
  explicit SplitEdges(Work& work) : work_(work) {}

  void run(std::vector<EdgeNode>& nodes);

  // Calls visit(half-edge) for all parts of both sides of the edge.
  template <class Visit>
  void for_parts(std::uint32_t edge, Visit&& visit) const {
    const auto found = std::lower_bound(parts_.begin(), parts_.end(), edge, [](const EdgeParts& p, std::uint32_t e) { return p.edge < e; });
    const bool split = found != parts_.end() && found->edge == edge;
    visit(edge);
    visit(split ? found->twin : work_.halves[edge].twin);
    for (std::uint32_t i = 0; split && i < found->count; ++i) { visit(found->rest + i), visit(found->rest_of_twin + i); }
  }
  [[nodiscard]] const std::vector<EdgeParts>& parts() const { return parts_; }

 private:
  void split(std::uint32_t h, std::vector<EdgeNode> nodes);
  void insert(std::uint32_t whole, std::uint32_t before, std::uint32_t added, std::uint32_t point);

  Work& work_;
  std::vector<EdgeParts> parts_;  // by rising edge
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/split_edges.cpp>
#endif
