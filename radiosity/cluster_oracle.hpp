// SPDX-License-Identifier: MIT
#pragma once

// The oracle for pairs with a cluster: may they be linked here? Both must lie well apart, so that one direction stands for all of
// the other end, and neither may fill more of the other's view than epsilon allows, just as the F-oracle asks of patches. The
// estimate bounds what any face in them can see: the area shown, in the worst direction of the lattice near by, at the least distance.
//
// As epsilon and min_area go to 0 every pair is opened down to its faces, and the links are those of a scene without clusters.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include <radiosity/clusters.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/oracle.hpp>

namespace radiosity {

// Distance of the centres over the sum of the radii, at least.
inline constexpr double cluster_separation = 1.5;

// What the node shows to places in the direction d (unit length), from above.
[[nodiscard]] inline double most_shown(const Node& node, const ShownAreas& shown, const glm::dvec3& d, double spread) {
  if (!node.is_cluster()) { return node.area * std::clamp(glm::dot(node.normal, d) + spread, 0.0, 1.0); }
  const Aim towards = aim(d);
  double most = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::uint32_t k = towards.direction[j];
    const glm::dvec3 lattice{detail::direction_lattice.x[k], detail::direction_lattice.y[k], detail::direction_lattice.z[k]};
    most = std::max(most, shown.of(node)[k] / glm::length(lattice));
  }
  return std::min(most, std::numbers::pi * node.radius * node.radius);
}

// The two nodes are different; `min_area` in the unit of the node areas.
[[nodiscard]] inline Decision cluster_oracle(const Hierarchy& hierarchy, std::uint32_t p, std::uint32_t q, const ShownAreas& shown,
                                             double epsilon, double min_area) {
  const Node& a = hierarchy[p];
  const Node& b = hierarchy[q];
  // A patch that may not be split any more leaves it to the cluster.
  const auto splits = [&](const Node& node) { return node.is_cluster() || !node.leaf() || node.area > min_area; };
  const Decision larger = splits(a) && (a.radius >= b.radius || !splits(b)) ? Decision::split_p : Decision::split_q;
  const glm::dvec3 to_b = b.centre - a.centre;
  const double r = glm::length(to_b);
  const double extent = a.radius + b.radius;
  if (!(r >= cluster_separation * extent)) { return larger; }
  if (std::max(a.area, b.area) <= min_area) { return Decision::link; }
  const glm::dvec3 d = to_b / r;
  const double spread = extent / r;
  const double seen = std::max(most_shown(a, shown, d, spread), most_shown(b, shown, -d, spread));
  return seen <= epsilon * std::numbers::pi * (r * r + seen) ? Decision::link : larger;
}

}  // namespace radiosity
