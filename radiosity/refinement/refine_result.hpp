// SPDX-License-Identifier: MIT
#pragma once

// What F-refinement (f_refine.hpp) is asked for, and what it has found.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// Which pairs of input faces are linked: all, or those of which one is a lamp (DiscreteScene::lamps). The latter need a hierarchy without
// clusters, or with clusters of lamps alone (make_lamp_clusters()).
enum class Linked { all, lamps };

struct RefineResult {
  NodePairs linked;                 // pairs that are to be linked
  OccluderLists occluders;          // of these pairs
  std::uint64_t pairs_tested = 0;   // questions to the oracle
  std::uint64_t pairs_dropped = 0;  // proven to face away from each other
  std::uint64_t pairs_hidden = 0;   // proven to be hidden from each other by one object, or one is buried
  std::uint64_t pairs_dark = 0;     // of input faces: neither emits, and light that reflects reaches neither
  std::uint64_t pairs_convex = 0;   // never asked: faces of one flat sheet or one convex solid cannot see each other
  RayCount rays;                    // segments cast to find shadow boundaries
  std::uint32_t generations = 0;
  std::vector<std::uint32_t> inner;  // leaves of concave curved objects: their children will see each other
  bool cancelled = false;
  std::uint64_t too_many = 0;   // links that would be needed, at least, when that is more than `link_limit`
  std::uint64_t too_large = 0;  // bytes that would be needed, at least, when that is more than the budget allows
};

}  // namespace radiosity
