// SPDX-License-Identifier: MIT
#pragma once

// Extends the hierarchy upwards to one tree above all input faces, so that not all pairs of them need to be compared (the paper's O(k^2)
// initial linking). A link of the root with itself represents the whole scene, and refinement begins there (Smits, Arvo and Greenberg
// 1994; Sillion 1995).
//
//   inside an object   clusters of faces over the dual graph of its BRep (face_clusters.hpp)
//   above the objects  the groups of a bounding volume hierarchy over their bounds
//   rooms              a room encloses every other object, so no cluster can hold it together with some of them: its faces, or their
//                      clusters, become children of the root
//
// Binary trees are flattened: a cluster has up to eight children, and few clusters have less than four. Each child of a cluster is a
// cluster or an input face. Clusters do not mix the faces of an object with those of others, except for the groups above objects.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <raycast/box.hpp>

#include <radiosity/clusters/face_clusters.hpp>
#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

// The groups and items below `top` in the binary tree that become children of one cluster. `sizes`: number of items below each.
std::vector<std::uint32_t> children_of(const Grouping& tree, std::uint32_t top, const std::vector<std::uint32_t>& sizes);

// Bounds of every item (the roots with these numbers) and of every group.
std::vector<raycast::Box> bounds_of(const Grouping& tree, const Hierarchy& roots, const std::vector<std::uint32_t>& numbers);

}  // namespace detail

// Inserts clusters above the roots made by make_roots(), of which there must be at least two. Updates the node numbers stored at the
// faces of the surfaces.
[[nodiscard]] Hierarchy make_clusters(std::vector<Surface>& surfaces, const Hierarchy& roots);

// Inserts clusters only above emitting roots, because their light is carried by links and all other light by stored rays (rays/). All
// other roots come first and stay roots. `exitance`: of each input surface; black if it does not count as a lamp. Lamps in the same tree
// differ in their brightest channel by at most a factor of 4, in the others by less than a quarter of it: what a patch sees of a cluster
// may be lamps of any of its colours.
[[nodiscard]] Hierarchy make_lamp_clusters(std::vector<Surface>& surfaces, const Hierarchy& roots, const std::vector<Color>& exitance);

// The projected area of each cluster in each direction of the lattice.
class ShownAreas {
 public:
  ShownAreas() = default;
  // `area(node)`: the area of a node that counts.
  template <class Area>
  ShownAreas(const Hierarchy& hierarchy, const Area& area) {
    std::size_t end = 0;  // end of the clusters and input faces
    std::size_t clusters = 0;
    for (; end < hierarchy.size() && (hierarchy[end].is_cluster() || is_input_face(hierarchy, end)); ++end) {
      clusters += hierarchy[end].is_cluster() ? 1 : 0;
    }
    areas_.assign(clusters * direction_count, 0.0);
    for (std::size_t i = end; i-- > 0;) {
      if (hierarchy[i].parent == no_node) { continue; }
      double* const to = &areas_[hierarchy[hierarchy[i].parent].cluster * direction_count];
      if (hierarchy[i].is_cluster()) {
        const double* const from = of(hierarchy[i]);
        for (std::size_t k = 0; k < direction_count; ++k) { to[k] += from[k]; }
      } else {
        add_shown(hierarchy[i].normal, area(i), to);
      }
    }
  }

  // The projected areas of a cluster in all directions.
  [[nodiscard]] const double* of(const Node& cluster) const { return &areas_[cluster.cluster * direction_count]; }
  [[nodiscard]] double of(const Node& cluster, const Aim& towards) const;

 private:
  std::vector<double> areas_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/clusters/clusters.cpp>
#endif
