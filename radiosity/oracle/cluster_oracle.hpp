// SPDX-License-Identifier: MIT
#pragma once

// The oracle for pairs with a cluster: may they be linked here? Both must lie well apart, so that one direction stands for all of
// the other end, and neither may fill more of the other's view than epsilon allows, just as the F-oracle asks of patches. The
// estimate bounds what any face in them can see: the area shown, in the worst direction of the lattice near by, at the least distance.
//
// As epsilon and min_area go to 0 every pair is opened down to its faces, and the links are those of a scene without clusters.

#include <glm/vec3.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

// Distance of the centres over the sum of the radii, at least.
inline constexpr double cluster_separation = 1.5;

// What the node shows to places in the direction d (unit length), from above.
[[nodiscard]] double most_shown(const Node& node, const ShownAreas& shown, const glm::dvec3& d, double spread);

// Of two different nodes, one of them a cluster.
struct ClusterOracle {
  [[nodiscard]] Decision operator()(const Question& question) const;
};
static_assert(Oracle<ClusterOracle>);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/cluster_oracle.cpp>
#endif
