// SPDX-License-Identifier: MIT
#pragma once

// Estimates the relative L2 error of a solution (paper 4.4): from the variation that its links cannot express (LinkVariation) times the
// radiosity that they carry, and from the variation over its leaves. For p receiving from q, with the irradiance H = G B_q / A_p and the
// deviation S = G s_q / A_p, s_q the standard deviation of B over q's leaves:
//
//     e_p^2 = A_p rho^2 H^2 (rest_p^2 + shadow_p^2)                        reduced by splitting p
//           + A_p rho^2 S^2 (rest_q^2 + shadow_q^2 + cross^2)              reduced by splitting q
//           + A_p rho^2 (sampling B_q / A_p)^2                             reduced by splitting the larger
//
// summed over the channels, and likewise for q receiving from p. The variation over leaves is added (leaf_error.hpp).
//
// Links at one node err alike, as in a corner of a room, so their `rest` terms are added before squaring. If only a sample of the links
// is measured, the ratio is taken from the row sums (DoubtSum::alike). These are for constant light; for varying light the truth lies
// between that and independence, so the geometric mean of both is used. Where the gradients of different links cancel over the leaves, as
// in a furnace, rests cancel by the same factor.
//
// A cluster shows different faces in each direction, so the mean of B^2 is used for the square of what it sends; the noise of sampling is
// reduced by splitting the source; and the S terms of different links of one node are added before squaring, because each mixes bright
// and dark faces in the same way. The total estimate is sqrt(sum of all e^2) over the norm of the reflected radiosity; other errors of
// different links count as independent. The propagation of errors by further reflections is neglected.

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/link_error_terms.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

namespace detail {

// Share of the variation over a leaf that counts as error: all of it for constant display, half of it for a picture that interpolates.
[[nodiscard]] constexpr double leaf_part(Reconstruction kind) { return kind >= Reconstruction::constant ? 1.0 : 0.5; }

// Squared errors.
struct ErrorEstimation {
  std::vector<LinkError> links;
  double of_links = 0.0, of_leaves = 0.0;
  double unseen = 0.0;  // the part of of_links from links whose segments were all blocked
  double norm = 0.0;    // of the reflected radiosity

  [[nodiscard]] double sum(double part) const { return of_links + part * part * of_leaves; }
  // Where nothing is lit by the solution, but may be, all of the light may be missing: 1.
  [[nodiscard]] double relative(double part) const {
    if (!(norm > 0.0)) { return sum(part) > 0.0 ? 1.0 : 0.0; }
    return std::sqrt(sum(part) / norm);
  }
};

// Errors of links only, and the norm.
ErrorEstimation estimate_link_errors(const AlikeErrors& alike, const DiscreteScene& scene, const MeasuredLinks& links,
                                     const std::vector<Color>& radiosity);

// For links that were not made by BF-refinement, in two tables (the second made by rays), and for pairs left out because all segments
// were blocked. Measures a sample, drawn by the light carried: at most 1024 of the links and of the left-out pairs that contain a light,
// 3072 other links of each table, and 1024 other pairs. Links between adjacent patches are measured by Lambert's contour integral.
ErrorEstimation sampled_estimate(const DiscreteScene& scene, const std::array<std::span<const Link>, 2>& links,
                                 const std::vector<Color>& radiosity, const EvaluateResult& evaluated);

// A sentence that says why the estimate is no bound, or nothing. The estimate does not include light that no segment found, nor the
// growth of errors that are reflected repeatedly (a closed scene keeps its row sums, so its errors have no mean); and it is relative to
// the light that was computed, of which a large error is a part. `estimate`: of the leaves; `unseen`: share of its square from links whose
// segments were all blocked.
std::string estimate_doubt(const DiscreteScene& scene, Transport& transport, const std::vector<Color>& radiosity, double estimate,
                           double unseen, bool closed);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/link_error.cpp>
#endif
