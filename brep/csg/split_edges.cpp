// SPDX-License-Identifier: MIT
#include <brep/csg/split_edges.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/contacts.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/work.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE void SplitEdges::run(std::vector<EdgeNode>& nodes) {
  std::sort(nodes.begin(), nodes.end(), [](const EdgeNode& a, const EdgeNode& b) { return a.edge < b.edge; });
  for (std::size_t i = 0; i < nodes.size();) {
    std::size_t end = i;
    while (end < nodes.size() && nodes[end].edge == nodes[i].edge) { ++end; }
    split(nodes[i].edge, {nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes.begin() + static_cast<std::ptrdiff_t>(end)});
    i = end;
  }
}

HALFLIGHT_INLINE void SplitEdges::split(std::uint32_t h, std::vector<EdgeNode> nodes) {
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

HALFLIGHT_INLINE void SplitEdges::insert(std::uint32_t whole, std::uint32_t before, std::uint32_t added, std::uint32_t point) {
  WorkHalf& half = work_.halves[added];
  half = work_.halves[whole];
  half.point = point;
  const std::uint32_t after = work_.halves[before].next;
  work_.link(before, added);
  work_.link(added, after);
}

}  // namespace brep::csg::detail
