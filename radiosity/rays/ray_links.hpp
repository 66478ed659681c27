// SPDX-License-Identifier: MIT
#pragma once

// Links made of stored rays (stored_rays.hpp): light between surfaces that do not shine, where links chosen by form factor would be many
// and weak.
//
// They are cast from the nodes over which such light changes little (spacing.hpp), whether or not the light of a lamp has split these
// further: what arrives is the same for all leaves below.
//
// A ray is one more sample of the kernel between two points, whoever cast it: with d the number of rays a node casts for each unit of its
// area, a ray between nodes i and j stands for an exchange of 1 / (d_i + d_j) (balance heuristic, Veach and Guibas 1995). So rays in
// both directions count for both, and the links are symmetric like all others.
//
// A long ray tells about more than one such node: at each end it is counted for the largest ancestor that is small beside the length of
// the ray, and beside the distance of what is seen from the ancestor (Ward, Rubinstein and Clear 1988), so that nothing near makes the
// light change within it. The link of two such ancestors pools all the rays between them, and the places where they start give its
// gradients. Rays are few for each node that casts and many for each link.

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
  std::uint64_t rays = 0;             // they were made of
  std::vector<std::uint32_t> caster;  // of each node: itself or the node above it that casts, or no_node
  std::vector<double> share;          // of the rays of each node: those that links stand for
  std::vector<double> density;        // of the rays that start on each node, by its area

  // What the row sums of the leaves should be, given those that these links sum up to, and those of the links of lamps. In the mean over a
  // node that casts there are two or three estimates: what the links sum up to, by rays in both directions; the share of its own rays;
  // and of surfaces that lose no light what lamps leave of 1. Each counts by the inverse of its variance: of ground under the sky the few
  // rays that meet a house tell little, and what the sky leaves of 1 is mostly the error of the sky's links, but rays out of the house tell
  // much. Within the node: by what lamps leave of the horizon of each leaf, for a ray that a lamp stops meets nothing else.
  // `transport` knows which surfaces lose none; `made`: the links, wherever they are now. `error_of_lamps`: expected RMS error of the row
  // sums of the links of lamps, taken to be the same part of each.
  [[nodiscard]] std::vector<double> row_sums(const DiscreteScene& scene, const Transport& transport, const Links& made,
                                             const std::vector<double>& computed, const std::vector<double>& of_lamps,
                                             double error_of_lamps) const;
  // What the noise of the rays adds to the squared L2 error of a solution. The mean of what arrives at a node is known, by its own rays;
  // which of the others it comes from is not. `made`: the links, wherever they are now.
  [[nodiscard]] double noise(const DiscreteScene& scene, const Links& made, const std::vector<Color>& radiosity) const;
};

// How many rays each node casts: `mean` if all casters were of one size and weight 1; by the root of the area and by the weight, which is
// best for the L2 error. Lamps are no casters: their light has links of its own. For the picture of one camera weights may be any: above
// four millions there are no more rays in all than `mean` a caster.
[[nodiscard]] std::vector<std::uint32_t> ray_counts(const DiscreteScene& scene, const std::vector<Caster>& casters, double mean);

// So many rays a node that their noise falls with the other errors of F-refinement: measured on rooms of 19 to 10 000 input faces.
[[nodiscard]] double rays_per_node(double epsilon);

[[nodiscard]] RayLinks make_ray_links(const DiscreteScene& scene, const StoredRays& rays, const std::vector<Caster>& casters);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/rays/ray_links.cpp>
#endif
