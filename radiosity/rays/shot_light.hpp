// SPDX-License-Identifier: MIT
#pragma once

// The light that bright leaves send, sampled by rays that start on them. Sixteen rays from a large wall miss a small bright spot in front
// of it; rays from the spot hit the wall.
//
// Both kinds of rays are combined by the balance heuristic (Veach and Guibas 1995): a ray between points of i and j, from either end,
// represents an exchange of 1 / (d_i + d_j), with d the number of rays per area that start on a node.

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
    std::uint32_t from = no_node, on = no_node;  // the emitting leaf at the time of casting; the open node that was hit
    double length = 0.0;
  };

  // No rays.
  ShotLight() = default;
  // Casts some 4096 rays, distributed over the leaves by area times `brightness` (by node).
  ShotLight(const DiscreteScene& scene, const LeafLocator& locator, const std::vector<double>& brightness);

  // Rays per area that start on a node; for a node made after casting, that of the leaf of which it is a part.
  [[nodiscard]] double density(const Hierarchy& hierarchy, std::uint32_t node) const;
  // The rays that hit one of the nodes marked in `open`, or a descendant.
  [[nodiscard]] std::vector<Ray> on(const Hierarchy& hierarchy, const LeafLocator& locator, const std::vector<bool>& open) const;

 private:
  struct Landed {
    std::uint32_t from = no_node, surface = 0;
    double length = 0.0;
    raycast::SurfacePoint at;
  };
  std::vector<Landed> rays_;
  std::vector<double> density_;  // of the nodes that existed at the time of casting
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/shot_light.cpp>
#endif
