// SPDX-License-Identifier: MIT
#pragma once

// Radiosity by the plain program that one would write instead of a hierarchy, in a hundred lines; what the hierarchy is worth shows against
// it. Each leaf samples the lamps by quasi-random points, chosen by power, with a shadow ray to each, and keeps a list of the leaves that
// its cosine-distributed rays meet (stored_rays.hpp). All further light is gathered over these lists, again and again (Jacobi).
//
// Lists are not reciprocal: each leaf has its own noise, which the whole solution averages, and no exchange is known from both ends.
// Where lamps are more than a tenth of the surface the lists carry their light, too: points on a lamp that touches the leaf have a
// variance without bound.

#include <cstdint>

#include <radiosity/matrix/dense.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

// Of the largest leaf. Others have fewer, as the root of their area, but 16 points and 4 rays at least.
struct ListEffort {
  std::uint32_t lamp_points = 32;
  std::uint32_t rays = 64;
};

// Gathers until the residual (DenseSolution) is at most `wanted`. The radiosity has one entry a node, that of leaves is filled in. The same
// for any number of threads.
[[nodiscard]] DenseSolution gather_by_lists(const DiscreteScene& scene, const ListEffort& effort, double wanted,
                                            std::uint32_t max_iterations);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/matrix/gather_lists.cpp>
#endif
