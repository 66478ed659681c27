// SPDX-License-Identifier: MIT
#pragma once

// The exchange between two planar patches, G = A_i F_ij = A_j F_ji, without occlusion. One number serves both
// directions, so reciprocity holds exactly; the links store it.
//
//   far    product Gauss quadrature of the kernel cos cos / (pi r^2)
//   small  one patch a thousand times smaller: Lambert's contour of the other, averaged over it
//   near   both contours: G = 1/(2 pi) closed integral over both contours of ln r dx_i . dx_j (Lambert 1760,
//          in the form of Sparrow 1963). It has no singular kernel: touching patches are as exact as distant ones.
//
// Patches that reach below each other's horizon are clipped first. Error for planar patches: below 2e-5 of G by the far rules (see
// facing_exchange), below 1e-8 of the smaller area and 1e-14 of the squared extent by the near rule, whatever the angles of the edges; by
// the small rule that of three Gauss points a side on the small patch.

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/exchange/edge_pair.hpp>
#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

namespace detail {

// Edges of a contour, those of no length left out.
std::vector<Edge> edges_of(std::span<const glm::dvec3> contour);

// Near rule: errs by at most `tolerance` and rounding, 1e-14 scale^2 or so. `scale` is the extent of both contours together.
[[nodiscard]] double contour_exchange(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double scale, double tolerance);

}  // namespace detail

// Is any part of `q` above the plane of `p`? 1 all of it, 0 some, -1 none. Parts within `share` of the extent of both count as on it, and
// those within the rounding of coordinates: each is known to half a unit in the last place, the plane to as much over its radius.
[[nodiscard]] int above_horizon(const Patch& p, const Patch& q, double share = 1e-12);

// How the unoccluded light between two patches changes across one of them: the linear function with the same first moments at the
// Gauss points, and what it leaves. RMS values are relative to the mean.
struct Variation {
  glm::dvec3 slope{0.0};  // relative change per length, a vector in the plane of the patch
  double linear = 0.0;    // RMS of the linear part
  double rest = 0.0;      // RMS of the rest
  double limited = 0.0;   // RMS of what variations() has taken off the linear part
};
struct Variations {
  Variation p, q;
  double cross = 0.0;  // RMS of what is left of the kernel itself, over both patches, beyond both variations: which part of one is
                       // lit by which of the other
  double light = 0.0;  // the exchange by this rule; on curved objects with the true normals
};

// A patch that the other's horizon cuts is lit on one side of the cut alone, perhaps where no Gauss point lies: over a share s of its area,
// which varies by sqrt(1 / s - 1) at least.
//
// The slopes are limited so that the kernel stays positive on both patches; what that takes off is told apart. Normals turn over
// curved patches as they do over the surface (bend.hpp).
[[nodiscard]] Variations variations(const Patch& p, const Patch& q);

// How the unoccluded light of q changes across p, by Lambert's contour of q at the Gauss points of p: exact at these points however near q
// lies. The kernel of variations() is several times as large beside a common edge, and so are its slope and its rest. Normals turn over a
// curved p; q counts as its chord.
[[nodiscard]] Variation variation_by_contour(const Patch& p, const Patch& q);
// Do patches lie so near each other, for their size, that variations() is not to be relied on?
[[nodiscard]] bool too_near_for_kernel(const Patch& p, const Patch& q);

namespace detail {

// The part of a patch above the plane of another one.
[[nodiscard]] Patch above(const Patch& patch, const Patch& other);

}  // namespace detail

// G = A_p F_pq in the unit of the squared coordinates; 0 when the patches do not face each other. `known`: variations(p, q), if they are
// known; they have summed the kernel that a far rule would sum.
[[nodiscard]] double exchange(const Patch& p, const Patch& q, const Variations* known = nullptr);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/exchange/exchange.cpp>
#endif
