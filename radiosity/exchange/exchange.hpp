// SPDX-License-Identifier: MIT
#pragma once

// The exchange between two planar patches, G = A_i F_ij = A_j F_ji, without occlusion. One number serves both
// directions, so reciprocity holds exactly; the links store it.
//
//   far    product Gauss quadrature of the kernel cos cos / (pi r^2)
//   small  for a patch a thousand times smaller than the other: Lambert's contour integral of the large one, averaged over the small one
//   near   double contour integral G = 1/(2 pi) int int ln r dx_i . dx_j over both contours (Lambert 1760, in the form of Sparrow 1963).
//          Its integrand is only weakly singular, so touching patches are as exact as distant ones.
//
// Patches that reach below each other's horizon are clipped first. Error for planar patches: far rule, below 2e-5 of G (see
// facing_exchange); near rule, below 1e-8 of the smaller area plus 1e-14 of the squared extent, whatever the angles of the edges; small
// rule, that of three Gauss points a side on the small patch.

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/exchange/edge_pair.hpp>
#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

namespace detail {

// The edges of a contour, except those of length 0.
std::vector<Edge> edges_of(std::span<const glm::dvec3> contour);

// Near rule, with an error of at most `tolerance` plus about 1e-14 scale^2 of rounding. `scale`: common extent of both contours.
[[nodiscard]] double contour_exchange(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double scale, double tolerance);

}  // namespace detail

// Is q above the plane of p? 1: all of it, 0: a part, -1: nothing. Heights within `share` of the common extent count as 0, and so do
// those within the rounding error of coordinates: half a unit in the last place for a point, and for the plane that error divided by its
// radius.
[[nodiscard]] int above_horizon(const Patch& p, const Patch& q, double share = 1e-12);

// How the unoccluded light between two patches varies across one of them: the linear function with the same first moments at the Gauss
// points, and the remainder. RMS values are relative to the mean.
struct Variation {
  glm::dvec3 slope{0.0};  // relative change per length, a vector in the plane of the patch
  double linear = 0.0;    // RMS of the linear part
  double rest = 0.0;      // RMS of the rest
  double limited = 0.0;   // RMS by which variations() has reduced the linear part
};
struct Variations {
  Variation p, q;
  // RMS of the kernel over both patches beyond both variations, because which part of one patch is lit depends on the part of the other.
  double cross = 0.0;
  double light = 0.0;  // exchange by this rule; on curved objects with the true normals
};

// A patch cut by the other's horizon is lit only on one side of the cut, possibly where no Gauss point lies: if the lit share of its area
// is s, the RMS variation is at least sqrt(1 / s - 1).
//
// The slopes are limited so that the kernel stays positive on both patches; Variation::limited tells by how much. On curved patches the
// normals vary as they do on the surface (bend.hpp).
[[nodiscard]] Variations variations(const Patch& p, const Patch& q);

// How the unoccluded light of q varies across p, by Lambert's contour integral of q at the Gauss points of p: exact at these points,
// however near q is. Beside a common edge the kernel of variations() gives several times too large values, and so too large slopes and
// remainders. On a curved p the normals vary; q counts as its chord.
[[nodiscard]] Variation variation_by_contour(const Patch& p, const Patch& q);
// Are the patches too close to each other, relative to their size, for variations() to be accurate?
[[nodiscard]] bool too_near_for_kernel(const Patch& p, const Patch& q);

namespace detail {

// The part of a patch above the plane of `other`.
[[nodiscard]] Patch above(const Patch& patch, const Patch& other);

}  // namespace detail

// G = A_p F_pq in squared units of the coordinates; 0 if the patches do not face each other. `known`: variations(p, q), if already
// computed; it contains the kernel sum of one of the far rules.
[[nodiscard]] double exchange(const Patch& p, const Patch& q, const Variations* known = nullptr);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/exchange/exchange.cpp>
#endif
