// SPDX-License-Identifier: MIT
#pragma once

// Links made from stored rays (stored_rays.hpp), for light between surfaces that are not lamps, where links chosen by form factor would
// be many and weak.
//
// Rays are cast from nodes over which such light changes little (spacing.hpp), even if the light of a lamp has split these nodes further:
// what arrives is the same for all leaves below.
//
// A ray is a sample of the kernel between two points, whichever end cast it: with d the number of rays that a node casts per area, a ray
// between nodes i and j represents an exchange of 1 / (d_i + d_j) (balance heuristic, Veach and Guibas 1995). So rays in both directions
// count for both, and the links are symmetric like all others.
//
// A long ray is informative for more than one such node. At each end it is counted for the largest ancestor that is small compared with
// the length of the ray and with the distances of what parts of it see (Ward, Rubinstein and Clear 1988), so that nothing near makes the
// light vary within it. The link of two such ancestors pools all rays between them, and the start points of the rays give its gradients.
// So a casting node needs few rays, while a link gets many.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/rays/spacing.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

struct RayLinks {
  Links links;
  std::uint64_t rays = 0;             // rays from which the links were made
  std::vector<std::uint32_t> caster;  // by node: itself or its ancestor that casts, or no_node
  std::vector<double> share;          // by node: share of its rays that links represent
  std::vector<double> density;        // by node: rays that start on it, per area

  // Estimates the true row sums of the leaves from `computed` (the sums of these links) and `of_lamps` (those of the links of lamps). For
  // the mean over a casting node there are two or three estimates: the sum of the links, by rays in both directions; the share of its own
  // rays; and, on surfaces that lose no light, 1 minus the row sum of the lamps. They are weighted by their inverse variances. Example:
  // of the ground under the sky few rays meet a house, so their share says little, and 1 minus the sky's row sum is mostly the error of
  // the sky's links, but the rays from the house are informative. Within a casting node the result is distributed by the part of each
  // leaf's horizon that lamps leave free, because a ray stopped by a lamp meets nothing else. `transport` tells which surfaces lose no
  // light; `made`: the links, wherever they are now. `error_of_lamps`: expected RMS error of the lamps' row sums, taken to be the same
  // fraction of each.
  [[nodiscard]] std::vector<double> row_sums(const DiscreteScene& scene, const Transport& transport, const Links& made,
                                             const std::vector<double>& computed, const std::vector<double>& of_lamps,
                                             double error_of_lamps) const;
  // The squared L2 error that the noise of the rays adds to a solution. The mean of what arrives at a node is known from its own rays,
  // but not from which other nodes it comes. `made`: the links, wherever they are now.
  [[nodiscard]] double noise(const DiscreteScene& scene, const Links& made, const std::vector<Color>& radiosity) const;
};

// Numbers of rays per node: `mean` if all casters had equal size and weight 1; otherwise proportional to weight and square root of the
// area, which minimizes the L2 error. Lamps do not cast, because their light has links of its own. If weights are those of a camera's
// picture, the total is limited to four million, or its geometric mean with `mean` per caster if that is more.
[[nodiscard]] std::vector<std::uint32_t> ray_counts(const DiscreteScene& scene, const std::vector<Caster>& casters, double mean);

// Rays per node for which noise decreases along with the other errors of F-refinement: measured on rooms of 19 to 10 000 input faces.
[[nodiscard]] double rays_per_node(double epsilon);

[[nodiscard]] RayLinks make_ray_links(const DiscreteScene& scene, const StoredRays& rays, const std::vector<Caster>& casters);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/ray_links.cpp>
#include <radiosity/rays/ray_rows.cpp>
#endif
