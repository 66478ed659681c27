// SPDX-License-Identifier: MIT
#pragma once

// The oracle (paper 4.3, 4.4): may these two nodes exchange light by one link, or must one of them be split first? All oracles, ours and a
// user's, are values of one kind: a function of a Question that answers with a Decision.
//
//   ProofOracle    two nodes that cannot see each other; asked before all others
//   FOracle        F-refinement: the form factor estimate of a link must not exceed epsilon; with a cluster, ClusterOracle
//   LightOracle    F-refinement: nor may the light of a lamp vary too much over the receiver of a link; asked after FOracle
//   BfOracle       BF-refinement: which end of a link with a large error is split
//
// A user's oracle (Options::oracle) is asked in place of FOracle and of BfOracle. What it must promise:
//
//   - The same question has the same answer, from whichever thread it comes: many are asked at once, and results do not depend on threads.
//   - It answers link, split_p or split_q; drop only where no light passes. Two nodes that are proven not to see each other are not asked.
//   - It agrees to a link once patches are small enough. In any case two leaves of which neither is larger than min_area are linked, and
//     the limits on links and memory hold.

#include <concepts>
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
  split_p,  // too much light for one link: split the first,
  split_q,  // or the second node; a cluster is opened
};

inline constexpr Decision first_seeing = Decision::link;  // those before it end the matter

// By how much splitting each end of a link would reduce its squared error (link_error.hpp).
struct LinkError {
  float p = 0.0f, q = 0.0f;
  [[nodiscard]] float sum() const { return p + q; }
};

// What an oracle is asked. Lengths and areas are those of the frame (frame.hpp), in which the size of the scene lies in [1, 2). Either node
// may be a cluster, which has no normal and whose area is that of all faces below it.
struct Question {
  const Hierarchy& hierarchy;
  std::uint32_t p = no_node, q = no_node;    // equal: a leaf over which the light varies, is it split while its links stay? BF alone
  const ShownAreas& shown;                   // projected areas of the clusters
  double epsilon = 0.0;                      // largest form factor of a link; of LightOracle, share of the error
  double min_area = 0.0;                     // of a leaf that may be split
  const std::vector<bool>* stuck = nullptr;  // leaves that the BRep refused to split, if there are any

  // For LightOracle alone: what can stand between the nodes.
  const raycast::OccluderList* between = nullptr;
  RayCount* rays = nullptr;                // for LightOracle alone: counts the segments that it casts
  const Importance* importance = nullptr;  // for LightOracle alone: for which picture nodes count, if for one

  // Of BF-refinement alone: the link carries light, and its error is one of the largest.
  const LinkError* error = nullptr;

  [[nodiscard]] const Node& node_p() const { return hierarchy[p]; }
  [[nodiscard]] const Node& node_q() const { return hierarchy[q]; }
  // Can the node be split, or has it been?
  [[nodiscard]] bool can_split(std::uint32_t i) const {
    const bool is_stuck = stuck != nullptr && i < stuck->size() && (*stuck)[i];
    return !hierarchy[i].leaf() || (hierarchy[i].area > min_area && !is_stuck);
  }
};

template <class O>
concept Oracle = std::copy_constructible<O> && std::is_invocable_r_v<Decision, const O&, const Question&>;

// Any oracle, by one indirect call.
using AnyOracle = std::function<Decision(const Question&)>;
static_assert(Oracle<AnyOracle>);

}  // namespace radiosity
