// SPDX-License-Identifier: MIT
#pragma once

// The oracle for pairs with a cluster: may they be linked at this level? They must lie well apart, so that one direction represents all
// of the other end, and neither may have a larger form factor to the other than epsilon, as the F-oracle requires of patches. The
// estimate is an upper bound for every face in them: the largest projected area in the lattice directions near by, at the smallest
// distance.
//
// As epsilon and min_area go to 0 every pair is opened down to its faces, and the links are those of a scene without clusters.

#include <glm/vec3.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

// Least distance of the centres, relative to the sum of the radii.
inline constexpr double cluster_separation = 1.5;

// Upper bound of the projected area that the node shows in directions within `spread` of d (unit length).
[[nodiscard]] double most_shown(const Node& node, const ShownAreas& shown, const glm::dvec3& d, double spread);

// For two different nodes of which at least one is a cluster.
struct ClusterOracle {
  [[nodiscard]] Decision operator()(const Question& question) const;
};
static_assert(Oracle<ClusterOracle>);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/cluster_oracle.cpp>
#endif
