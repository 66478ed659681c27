// SPDX-License-Identifier: MIT
#pragma once

// The oracle (paper 4.3, 4.4): may these two nodes exchange light by one link, or must one of them be split first? Every oracle, built-in
// or user-defined, is a function of a Question that returns a Decision.
//
//   ProofOracle    finds nodes that cannot see each other; asked before all others
//   FOracle        F-refinement: the estimated form factor of a link must not exceed epsilon; pairs with a cluster: ClusterOracle
//   LightOracle    F-refinement: the light of a lamp must not vary too much over the receiver of a link; asked after FOracle
//   BfOracle       BF-refinement: which end of a link with a large error is split
//
// A user's oracle (Options::oracle) replaces FOracle and BfOracle. Its contract:
//
//   - It is deterministic and thread-safe: the same question always has the same answer, and many are asked at the same time.
//   - It answers link, split_p or split_q; drop only if no light passes. It is not asked about nodes that provably do not see each other.
//   - It agrees to a link once patches are small enough. In any case, two leaves not larger than min_area are linked, and the limits on
//     links and memory apply.

#include <cstdint>
#include <functional>
#include <type_traits>
#include <vector>

#include <raycast/shaft.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/importance.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

enum class Decision : unsigned char {
  drop,     // proven: the patches cannot face each other
  convex,   // proven: they lie in one plane or on one convex solid
  hide,     // proven: they cannot see each other
  link,     // exchange light at this level
  split_p,  // too much light for one link: split the first node
  split_q,  // split the second node; a cluster is opened
};

inline constexpr Decision first_seeing = Decision::link;  // the decisions before it are final

// By how much splitting each end of a link would reduce its squared error (link_error.hpp).
struct LinkError {
  float p = 0.0f, q = 0.0f;
  [[nodiscard]] float sum() const { return p + q; }
};

// A question to an oracle. Lengths and areas are in the frame (frame.hpp), in which the size of the scene is in [1, 2). Either node may
// be a cluster, which has no normal and whose area is the sum over all faces below it.
struct Question {
  const Hierarchy& hierarchy;
  std::uint32_t p = no_node, q = no_node;    // if p == q, a leaf: is it split while its links stay? Only in BF-refinement
  const ShownAreas& shown;                   // projected areas of the clusters
  double epsilon = 0.0;                      // largest form factor of a link; for LightOracle, share of the error
  double min_area = 0.0;                     // least area of a leaf that may be split
  const std::vector<bool>* stuck = nullptr;  // leaves that the BRep refused to split, or null

  // Only for LightOracle: the possible blockers between the nodes.
  const raycast::OccluderList* between = nullptr;
  RayCount* rays = nullptr;                // only for LightOracle: counts the segments that it casts
  const Importance* importance = nullptr;  // only for LightOracle: weights of the nodes in a picture, or null

  // Only for BF-refinement: the link's error, which is one of the largest.
  const LinkError* error = nullptr;

  [[nodiscard]] const Node& node_p() const { return hierarchy[p]; }
  [[nodiscard]] const Node& node_q() const { return hierarchy[q]; }
  // Can the node be split, or has it been split already?
  [[nodiscard]] bool can_split(std::uint32_t i) const {
    const bool is_stuck = stuck != nullptr && i < stuck->size() && (*stuck)[i];
    return !hierarchy[i].leaf() || (hierarchy[i].area > min_area && !is_stuck);
  }
};

template <class O>
concept Oracle = std::copy_constructible<O> && std::is_invocable_r_v<Decision, const O&, const Question&>;

// Holds any oracle, at the cost of one indirect call.
using AnyOracle = std::function<Decision(const Question&)>;
static_assert(Oracle<AnyOracle>);

}  // namespace radiosity
