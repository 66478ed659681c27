// SPDX-License-Identifier: MIT
#pragma once

// Clusters of the faces of one boundary: edges of its dual graph are contracted in order of cost (Willmott, Heckbert and Garland 1999;
// Garland, Willmott and Heckbert 2001). A contraction costs little when the two clusters together are flat and compact:
//
//     cost = A (1 - |sum A n| / A) + A / 16 (perimeter^2 / (4 pi A) - 1)
//
// with A the area of both. The factor A makes small clusters merge first, so that the tree grows evenly.
//
// Invariant: a cluster is connected over edges of the boundary, and every face is in exactly one tree.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Groups of items. Numbers below `items` are items, the others groups: number items + g has the members groups[g].
struct Grouping {
  std::uint32_t items = 0;
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::uint32_t> tops;  // items and groups that are in no group

  [[nodiscard]] bool is_group(std::uint32_t i) const { return i >= items; }
  [[nodiscard]] const std::vector<std::uint32_t>& members(std::uint32_t i) const { return groups[i - items]; }
};

// The items are input faces of the surface: the roots with these numbers. Groups have two members; each shell of the surface becomes one
// tree. O(n log n).
[[nodiscard]] Grouping cluster_faces(const Surface& surface, const Hierarchy& roots, const std::vector<std::uint32_t>& numbers);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/clusters/face_clusters.cpp>
#endif
