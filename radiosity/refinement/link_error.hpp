// SPDX-License-Identifier: MIT
#pragma once

// The relative L2 error of a solution, estimated from what its links cannot express (LinkVariation) times the radiosity that they carry
// (paper 4.4), and from what its leaves cannot. For p receiving from q, with the irradiance H = G B_q / A_p and the deviation
// S = G s_q / A_p, s_q the standard deviation of B over q's leaves:
//
//     e_p^2 = A_p rho^2 H^2 (rest_p^2 + shadow_p^2)                        reduced by splitting p
//           + A_p rho^2 S^2 (rest_q^2 + shadow_q^2 + cross^2)              reduced by splitting q
//           + A_p rho^2 (sampling B_q / A_p)^2                             reduced by splitting the larger
//
// summed over the channels, and the same for q receiving from p. What varies over a leaf is added to that (leaf_error.hpp).
//
// Links that lie at one node err alike, as in a corner of a room: their rest adds up as it is. Where only a sample of the links is looked
// at, the row sums tell how much that makes (DoubtSum::alike), for light that is the same everywhere; of light that is not, the truth lies
// between that and independence, and the geometric mean of both is taken. Where the gradients of different links cancel over the leaves,
// as they do in a furnace, rests cancel by the same factor.
//
// A cluster shows other faces to each direction: there the mean of B^2 stands for the square of what it sends, the noise of sampling is
// reduced by splitting the source, and the S of different links of one node add up as they are, for each mixes bright faces with dark ones
// in the same way. The estimate of the whole is sqrt(sum of all e^2) over the norm of the reflected radiosity: all other errors of
// different links count as independent. Errors that are passed on by further reflections are not followed.

#include <array>
#include <cmath>
#include <optional>
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

// How much of the variation over a leaf is an error: all of it, or the part that a picture which interpolates still misses.
[[nodiscard]] constexpr double leaf_part(Reconstruction kind) { return kind >= Reconstruction::constant ? 1.0 : 0.5; }

// All squared.
struct ErrorEstimation {
  std::vector<LinkError> links;
  double of_links = 0.0, of_leaves = 0.0;
  double unseen = 0.0;  // part of the links: those through which no segment came
  double norm = 0.0;    // of the reflected radiosity

  [[nodiscard]] double sum(double part) const { return of_links + part * part * of_leaves; }
  [[nodiscard]] double relative(double part) const { return norm > 0.0 ? std::sqrt(sum(part) / norm) : 0.0; }
};

// The errors of links alone, and the norm.
ErrorEstimation estimate_link_errors(const AlikeErrors& alike, const DiscreteScene& scene, const MeasuredLinks& links,
                                     const std::vector<Color>& radiosity);

// For links that were not made by BF-refinement, in two tables, and for pairs that were left out because no segment came through: from at
// most 1024 of either that hold a light, 3072 others of each table, and 1024 other pairs, drawn by what they carry; they are measured now,
// those between patches that lie beside each other by Lambert's contour. The second table was made by rays.
ErrorEstimation sampled_estimate(const DiscreteScene& scene, const std::array<std::span<const Link>, 2>& links,
                                 const std::vector<Color>& radiosity, const EvaluateResult& evaluated);

// Why the estimate is no bound, or nothing. It does not know what a segment never found, nor how errors grow when light that is wrong is
// reflected again and again; a closed scene keeps its row sums, and what errs there has no mean. `unseen`: share of its square that is
// due to links through which no segment came.
std::string estimate_doubt(const DiscreteScene& scene, Transport& transport, const std::vector<Color>& radiosity, double unseen,
                           bool closed);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/link_error.cpp>
#endif
