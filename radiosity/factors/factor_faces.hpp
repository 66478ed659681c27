// SPDX-License-Identifier: MIT
#pragma once

// Form factors between flat faces with flat blockers. Possible blockers are found with the planes of the shaft (the convex hull of both
// faces). If there are none, the exchange is that of exchange.hpp; if one of them hides everything, it is 0. Otherwise the exact
// point-to-polygon factor of the visible part of one face (shadow.hpp) is integrated over the smaller one (factor_integral.hpp).

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

namespace detail {

// Does the blocker meet every segment between a corner of p and a corner of q? Then it meets all segments between the two faces, because
// the part of q that it hides from a point is convex, and so is the set of points of p from which it hides a given corner of q.
[[nodiscard]] bool hides(const Blocker& blocker, std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double slack);

}  // namespace detail

struct ConvexFace {
  std::span<const glm::dvec3> contour;
  glm::dvec3 normal{0.0};  // unit length
};

// The exchange of two convex faces with blockers, in squared units of the coordinates. Blockers outside the shaft are ignored. `asked`:
// counts the evaluated points; unchanged if nothing stands in between.
[[nodiscard]] Estimate exchange(const ConvexFace& p, const ConvexFace& q, std::span<const Blocker> blockers, double slack,
                                const IntegralLimits& limits, std::uint64_t& asked);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_faces.cpp>
#endif
