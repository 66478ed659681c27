// SPDX-License-Identifier: MIT
#pragma once

// First step of the cut: every edge is split at the points of contact inside it, on both its faces.
//
// A split edge keeps its half-edges h and t as the first parts; the further parts lie in memory behind one another in the order in which
// they are walked. The second part of h is the twin of the last but one of t, and so on.

#include <algorithm>
#include <cmath>
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

  void run(std::vector<EdgeNode>& nodes) {
    std::sort(nodes.begin(), nodes.end(), [](const EdgeNode& a, const EdgeNode& b) { return a.edge < b.edge; });
    for (std::size_t i = 0; i < nodes.size();) {
      std::size_t end = i;
      while (end < nodes.size() && nodes[end].edge == nodes[i].edge) { ++end; }
      split(nodes[i].edge, {nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes.begin() + static_cast<std::ptrdiff_t>(end)});
      i = end;
    }
  }

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
  void split(std::uint32_t h, std::vector<EdgeNode> nodes) {
    const std::uint32_t t = work_.halves[h].twin;
    const Point from = work_.from(h), to = work_.to(h);
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::abs(to.position[i] - from.position[i]) > std::abs(to.position[axis] - from.position[axis])) { axis = i; }
    }
    const bool forward = work_.predicates.compare(from, to, axis) < 0;
    std::sort(nodes.begin(), nodes.end(), [&](const EdgeNode& a, const EdgeNode& b) {
      const int order = work_.predicates.compare(work_.points[a.point], work_.points[b.point], axis);
      return forward ? order < 0 : order > 0;
    });
    nodes.erase(std::unique(nodes.begin(), nodes.end(), [](const EdgeNode& a, const EdgeNode& b) { return a.point == b.point; }),
                nodes.end());
    std::erase_if(nodes, [&](const EdgeNode& n) { return n.point == work_.halves[h].point || n.point == work_.halves[t].point; });
    const auto count = static_cast<std::uint32_t>(nodes.size());
    if (count == 0) { return; }
    const auto rest = static_cast<std::uint32_t>(work_.halves.size()), rest_of_twin = rest + count;
    work_.halves.resize(rest + 2 * count);
    for (std::uint32_t i = 0; i < count; ++i) {
      insert(h, i == 0 ? h : rest + i - 1, rest + i, nodes[i].point);
      insert(t, i == 0 ? t : rest_of_twin + i - 1, rest_of_twin + i, nodes[count - 1 - i].point);
    }
    for (std::uint32_t i = 0; i <= count; ++i) {
      const std::uint32_t x = i == 0 ? h : rest + i - 1, y = i == count ? t : rest_of_twin + (count - i) - 1;
      work_.halves[x].twin = y;
      work_.halves[y].twin = x;
    }
    parts_.push_back({h, t, rest, rest_of_twin, count});
  }
  void insert(std::uint32_t whole, std::uint32_t before, std::uint32_t added, std::uint32_t point) {
    WorkHalf& half = work_.halves[added];
    half = work_.halves[whole];
    half.point = point;
    const std::uint32_t after = work_.halves[before].next;
    work_.link(before, added);
    work_.link(added, after);
  }

  Work& work_;
  std::vector<EdgeParts> parts_;  // by rising edge
};

}  // namespace brep::csg::detail
