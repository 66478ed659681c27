// SPDX-License-Identifier: MIT
#pragma once

// The F-oracle (paper 4.3, 4.4): a pair of patches is linked when its form factor estimate is at most epsilon. It looks at centre, normal
// and area alone.

#include <cstdint>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

// The point of the disk around a patch that is nearest to x.
[[nodiscard]] glm::dvec3 nearest_point(const Node& patch, const glm::dvec3& x);

// Input faces of more convex parts are always split into them: their contour is so long that a link costs more than the links of the parts.
inline constexpr std::uint32_t most_linked_parts = 64;

// The larger of both disk estimates F_pq and F_qp. Where a patch crosses the other's horizon the light changes from some to none
// across it, and the cosine of its highest point stands for that of its centre. Where the disks are closer than
// their size, the point of the larger one that is nearest to the smaller is looked at as well: a small lamp just above a large
// floor is far from its centre.
//
// Patches of regular meshes meet the conditions in here as equalities: a wall that stands on a floor has its lowest point in the floor's
// plane, squares lie at simple multiples of their size. `even` keeps rounding from deciding, so that scale and place do not matter.
[[nodiscard]] double form_factor_estimate(const Node& p, const Node& q);

// Proven: no part of one patch, however fine, lies above the plane of any part of the other.
[[nodiscard]] bool face_away(const Node& p, const Node& q);

// The rule of the F-oracle for two patches that may face each other. `min_area` in the unit of the node areas. The larger patch is split;
// patches of equal size within one part in a million count as equal, so that rounding never decides.
[[nodiscard]] Decision f_rule(const Node& p, const Node& q, double epsilon, double min_area);

// Of clusters ClusterOracle is asked, in its place.
struct FOracle {
  [[nodiscard]] Decision operator()(const Question& question) const;
};
static_assert(Oracle<FOracle>);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/f_oracle.cpp>
#endif
