// SPDX-License-Identifier: MIT
#pragma once

// What bright leaves send, by rays that leave them. Sixteen rays from a large wall miss a small bright spot before it; rays from the spot
// meet the wall.
//
// Both kinds of rays count together by the balance heuristic (Veach and Guibas 1995): a ray between points of i and j, from either end,
// stands for an exchange of 1 / (d_i + d_j), with d the number of rays that leave a node for each unit of its area.

#include <cstdint>
#include <vector>

#include <raycast/object.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/visibility/leaf_locator.hpp>

namespace radiosity {

class ShotLight {
 public:
  struct Ray {
    std::uint32_t from = no_node, on = no_node;  // the leaf that sends, when the ray was cast; the open node that is met
    double length = 0.0;
  };

  // No rays.
  ShotLight() = default;
  // Some 4096 rays, shared among the leaves by area times `brightness`, which is that of each node.
  ShotLight(const DiscreteScene& scene, const LeafLocator& locator, const std::vector<double>& brightness);

  // Rays that leave a node, by its area; of one that was made since, those of the leaf that it is a part of.
  [[nodiscard]] double density(const Hierarchy& hierarchy, std::uint32_t node) const;
  // The rays that meet one of the nodes that are marked in `open`, or something below.
  [[nodiscard]] std::vector<Ray> on(const Hierarchy& hierarchy, const LeafLocator& locator, const std::vector<bool>& open) const;

 private:
  struct Landed {
    std::uint32_t from = no_node, surface = 0;
    double length = 0.0;
    raycast::SurfacePoint at;
  };
  std::vector<Landed> rays_;
  std::vector<double> density_;  // of each node of then
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/shot_light.cpp>
#endif
