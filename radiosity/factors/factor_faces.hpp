// SPDX-License-Identifier: MIT
#pragma once

// Form factors between flat faces behind flat faces. What stands between two faces is found by the planes of their shaft (the convex hull
// of both); where nothing does, the exchange is that of exchange.hpp. Where one of them hides all, it is 0. Else the exact factor from a
// point to what it sees of the other face (shadow.hpp) is integrated over the smaller one (factor_integral.hpp).

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/visibility/polygon_shaft.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

namespace detail {

// Does the blocker stand in every segment between a corner of p and one of q? Then it does in all segments between the two: what it hides
// of q from a point is convex, and so are the points of p from which it hides a corner of q.
[[nodiscard]] bool hides(const Blocker& blocker, std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double slack);

}  // namespace detail

struct ConvexFace {
  std::span<const glm::dvec3> contour;
  glm::dvec3 normal{0.0};  // unit length
};

// The exchange of two convex faces behind blockers, in the squared unit of the coordinates. Those of the blockers that the shaft does not
// meet are left out; `asked` counts the points, and stays where it was when nothing stands in between.
[[nodiscard]] Estimate exchange(const ConvexFace& p, const ConvexFace& q, std::span<const Blocker> blockers, double slack,
                                const IntegralLimits& limits, std::uint64_t& asked);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_faces.cpp>
#endif
