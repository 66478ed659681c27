// SPDX-License-Identifier: MIT
#pragma once

// Parameters and result of F-refinement (f_refine.hpp).

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// Which pairs of input faces are linked: all, or those with a lamp (DiscreteScene::lamps). `lamps` requires a hierarchy without clusters,
// or with clusters of lamps only (make_lamp_clusters()).
enum class Linked { all, lamps };

struct RefineResult {
  NodePairs linked;                 // pairs that are to be linked
  OccluderLists occluders;          // of these pairs
  std::uint64_t pairs_tested = 0;   // questions to the oracle
  std::uint64_t pairs_dropped = 0;  // proven to face away from each other
  std::uint64_t pairs_hidden = 0;   // proven to be hidden from each other by one object, or one of them is buried
  std::uint64_t pairs_dark = 0;     // of input faces: neither emits, and no reflected light reaches either
  std::uint64_t pairs_convex = 0;   // never asked: faces of one flat sheet or one convex solid cannot see each other
  RayCount rays;                    // segments cast to find shadow boundaries
  std::uint32_t generations = 0;
  std::vector<std::uint32_t> inner;  // leaves of concave curved objects, whose children will see each other
  bool cancelled = false;
  std::uint64_t too_many = 0;   // lower bound of the links needed, if that exceeds `link_limit`
  std::uint64_t too_large = 0;  // lower bound of the bytes needed, if that exceeds the budget
};

}  // namespace radiosity
