// SPDX-License-Identifier: MIT
#pragma once

// The simple radiosity program that one would write without a hierarchy, in a hundred lines, as a baseline for the hierarchy. Each leaf
// samples the lamps at quasi-random points, chosen by power, with a shadow ray to each, and stores a list of the leaves that its
// cosine-distributed rays meet (stored_rays.hpp). Further light is gathered repeatedly over these lists (Jacobi iteration).
//
// The lists are not reciprocal: each leaf has independent noise, which averages out over the whole solution, and no exchange is computed
// from both ends. If lamps make up more than a tenth of the surface, the lists carry their light, too, because sampled points on a lamp
// that touches the leaf would have unbounded variance.

#include <cstdint>

#include <radiosity/matrix/dense.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// For the largest leaf. Others use fewer, in proportion to the square root of their area, but at least 16 points and 4 rays.
struct ListEffort {
  std::uint32_t lamp_points = 32;
  std::uint32_t rays = 64;
};

// Iterates until the residual (DenseSolution) is at most `wanted`. The radiosity has one entry per node; those of leaves are set. The
// result does not depend on the number of threads.
[[nodiscard]] DenseSolution gather_by_lists(const DiscreteScene& scene, const ListEffort& effort, double wanted,
                                            std::uint32_t max_iterations);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/matrix/gather_lists.cpp>
#endif
