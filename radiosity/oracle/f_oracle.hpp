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
