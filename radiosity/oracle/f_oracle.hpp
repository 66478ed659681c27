// SPDX-License-Identifier: MIT
#pragma once

// The F-oracle (paper 4.3, 4.4): a pair of patches is linked if its estimated form factor is at most epsilon. It uses only centre,
// normal, radius and area.

#include <cstdint>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

// The point nearest to x of the disk around a patch.
[[nodiscard]] glm::dvec3 nearest_point(const Node& patch, const glm::dvec3& x);

// Input faces of more convex parts are always split into them, because their contour is so long that a link with it costs more than links
// with the parts.
inline constexpr std::uint32_t most_linked_parts = 64;

// The larger one of the two disk estimates F_pq and F_qp. If a patch crosses the other's horizon, its light ranges from zero to some, and
// the cosine at its highest point is used instead of that at its centre. If the disks are closer than their size, the point of the larger
// one nearest to the smaller is used as well, because a small lamp just above a large floor is far from the floor's centre.
//
// Patches of regular meshes often meet the conditions here as equalities: a wall on a floor has its lowest point in the floor's plane,
// squares lie at simple multiples of their size. The factor `even` keeps rounding from deciding, so that scale and position do not matter.
[[nodiscard]] double form_factor_estimate(const Node& p, const Node& q);

// Is it proven that no part of one patch, however fine, lies above the plane of any part of the other?
[[nodiscard]] bool face_away(const Node& p, const Node& q);

// The rule of the F-oracle for two patches that may face each other. `min_area`: in the unit of the nodes' areas. The larger patch is
// split; areas within one part in a million count as equal, so that rounding never decides.
[[nodiscard]] Decision f_rule(const Node& p, const Node& q, double epsilon, double min_area);

// Questions about clusters are passed on to ClusterOracle.
struct FOracle {
  [[nodiscard]] Decision operator()(const Question& question) const;
};
static_assert(Oracle<FOracle>);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/f_oracle.cpp>
#endif
