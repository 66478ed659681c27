// SPDX-License-Identifier: MIT
#pragma once

// The oracle: may this pair of patches be linked here, or must one of them be split first (paper 4.3, 4.4)?
// It looks at centre, normal and area alone. F-oracle: the form factor estimate must not exceed a threshold.

#include <cstdint>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>

namespace radiosity {

enum class Decision : unsigned char {
  drop,     // proven: the patches cannot face each other
  convex,   // proven: they lie in one plane or on one convex solid
  hide,     // proven: they cannot see each other
  link,     // exchange light at this level
  split_p,  // too much light for one link: split the first,
  split_q,  // or the second patch
};

inline constexpr Decision first_seeing = Decision::link;  // those before it end the matter

// The point of the disk around a patch that is nearest to x.
[[nodiscard]] glm::dvec3 nearest_point(const Node& patch, const glm::dvec3& x);

// Input faces of more convex parts are always split into them: their contour is so long that a link costs more than the links of the parts.
inline constexpr std::uint32_t most_linked_parts = 64;

// F-oracle. `min_area` in the unit of the node areas. The larger patch is split; patches of equal size within
// one part in a million count as equal, so that rounding never decides.
[[nodiscard]] Decision f_oracle(const Node& p, const Node& q, double epsilon, double min_area);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/oracle.cpp>
#endif
