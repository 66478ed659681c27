// SPDX-License-Identifier: MIT
#pragma once

// The error of leaves by what varies over them. A link passes the linear part of its light on to the leaves below it, but a leaf i has one
// constant. With g_i the gradient of the irradiance that all links at i and above it bring there, added as vectors,
//
//     e_i^2 = A_i rho^2 (mean over i of (g_i . (x - c_i))^2)               reduced by splitting i, while its links stay where they are
//
// which is an error of the constants; of a picture, that interpolates between leaves, a part of it. On curved objects the gradients of the
// links, and so g, hold the turn of the normals (bend.hpp).

#include <algorithm>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

// By the variation of the light over each leaf, squared.
struct LeafErrors {
  std::vector<float> squares;  // one a node; none where the leaves are not told apart
  double sum = 0.0;
  double apart = 0.0;  // what the sum would be if links were independent

  // The gradients of links at one place add up or cancel (in a scene of uniform radiosity they cancel), and so do their other errors.
  [[nodiscard]] double alike() const { return apart > 0.0 ? std::clamp(sum / apart, 1e-4, 1e2) : 1.0; }
};

// Mean over a patch of the square of g . (x - c), c its centroid.
[[nodiscard]] double mean_square(const Patch& patch, const glm::dvec3& g);

// Of links that have their gradients, at leaves too.
LeafErrors estimate_leaf_errors(const DiscreteScene& scene, const Links& links, const std::vector<Color>& radiosity);

// The variation over leaves where the gradients at leaves are not known, from the differences between the leaves of one parent. Where light
// changes linearly over a parent of four leaves, squares or triangles, the variance within each is a third of that between them. Where
// some of the children were split once more, light changes more over these than over the leaves beside them: a leaf then varies by half
// the square of what it differs from the child that is most like it (over all directions of a gradient the mean for squares is 1 / 2.2).
// For a child that was split, the slope up to the nearest of its leaves tells that difference, because a bright child may begin where a
// leaf in shadow ends.
double variation_by_siblings(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<Color>& radiosity);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/leaf_error.cpp>
#endif
