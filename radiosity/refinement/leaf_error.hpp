// SPDX-License-Identifier: MIT
#pragma once

// The error of leaves caused by variation over them. A link passes the linear part of its light on to the leaves below, but a leaf i has
// a single constant. With g_i the gradient of the irradiance at i, summed as vectors over all links of i and its ancestors,
//
//     e_i^2 = A_i rho^2 (mean over i of (g_i . (x - c_i))^2)               reduced by splitting i, while its links stay where they are
//
// This is the error of the constants; a picture, which interpolates between leaves, has a part of it. On curved objects the gradients of
// the links, and so g, include the variation of the normals (bend.hpp).

#include <algorithm>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

// Squared errors by the variation of the light over each leaf.
struct LeafErrors {
  std::vector<float> squares;  // by node; empty if leaves are not evaluated individually
  double sum = 0.0;
  double apart = 0.0;  // the sum if the gradients of links were independent

  // Ratio of both sums. The gradients of links at one place add up or cancel (in a scene of uniform radiosity they cancel), and so do
  // their other errors.
  [[nodiscard]] double alike() const { return apart > 0.0 ? std::clamp(sum / apart, 1e-4, 1e2) : 1.0; }
};

// Mean of (g . (x - c))^2 over a patch, c its centroid.
[[nodiscard]] double mean_square(const Patch& patch, const glm::dvec3& g);

// Requires links with gradients, also at leaves. `each`: how many links each of a sample represents, or nothing if all are there. The
// square of a sum over a sample is too large by its variance, which is subtracted (Horvitz and Thompson 1952, for independent draws): the
// mean over samples is right, though single squares may be negative.
LeafErrors estimate_leaf_errors(const DiscreteScene& scene, const Links& links, const std::vector<Color>& radiosity,
                                std::span<const double> each = {});

// Estimates the same sum if the gradients at leaves are not known, from the differences between sibling leaves. Where light is linear
// over a parent of four leaves, squares or triangles, the variance within each is a third of that between them. Where some of the
// children have been split once more, light varies more over these than over the leaves beside them: the variance of a leaf is then taken
// as half of the squared difference from its most similar sibling (for squares the mean over all directions of a gradient is 1 / 2.2).
// For a sibling that was split, that difference is extrapolated from the nearest of its leaves, because a bright sibling may begin where
// a leaf in shadow ends.
double variation_by_siblings(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<Color>& radiosity);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/leaf_error.cpp>
#endif
