// SPDX-License-Identifier: MIT
#pragma once

// What F-refinement asks about every pair of nodes: the F-oracle of two patches, the oracle of clusters, and before either whether the
// two lie in one plane or on one convex solid, so that no part of one sees any of the other, and whether one of them is buried.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <raycast/transform.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/buried.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/oracle/cluster_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

// What every pair is asked.
class PairOracle {
 public:
  // The references must outlive the oracle; the hierarchy holds clusters and input faces when it is made, and may grow.
  PairOracle(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy)
      : surfaces_{&surfaces},
        hierarchy_{&hierarchy},
        shown_{hierarchy, [&](std::size_t i) { return hierarchy[i].area; }},
        buried_{buried_nodes(surfaces, hierarchy)} {}

  [[nodiscard]] const ShownAreas& shown() const { return shown_; }

  // Do both lie in one plane or on one convex solid?
  [[nodiscard]] bool convex(const Node& a, const Node& b) const {
    if (a.object != b.object || a.object == no_node) { return false; }
    const raycast::PlacedObject& object = *(*surfaces_)[a.object].object;
    const bool sees_itself = object.inside() || !object.convex();
    return !sees_itself || (object.flat() && a.surface == b.surface && a.surface != no_node);
  }
  // Of a node that was there when the oracle was made: is nothing of it to be seen?
  [[nodiscard]] bool buried(std::uint32_t i) const { return i < buried_.size() && buried_[i]; }
  [[nodiscard]] const std::vector<bool>& buried() const { return buried_; }
  // Two nodes, or a cluster and itself, which is split.
  [[nodiscard]] Decision operator()(std::uint32_t p, std::uint32_t q, double epsilon, double min_area) const {
    const Node& a = (*hierarchy_)[p];
    const Node& b = (*hierarchy_)[q];
    if (convex(a, b)) { return Decision::convex; }
    if (buried(p) || buried(q)) { return Decision::hide; }
    if (p == q) { return Decision::split_p; }
    if (a.is_cluster() || b.is_cluster()) { return cluster_oracle(*hierarchy_, p, q, shown_, epsilon, min_area); }
    return f_oracle(a, b, epsilon, min_area);
  }

 private:
  const std::vector<Surface>* surfaces_;
  const Hierarchy* hierarchy_;
  ShownAreas shown_;
  std::vector<bool> buried_;
};

}  // namespace radiosity
