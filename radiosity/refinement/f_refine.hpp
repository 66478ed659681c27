// SPDX-License-Identifier: MIT
#pragma once

// F-refinement (paper 4.4): every pair of input faces is linked if the oracle allows it, otherwise a patch is split; for lamps
// the light oracle is asked as well. The work proceeds in generations: the oracles answer for all open pairs in parallel, then
// links and splits are carried out in the order of the pairs and of the nodes. So the result is the same for any number of
// threads, and a split requested by many pairs happens once.
//
// If there are clusters (clusters.hpp) the work begins with the pair of their root with itself, and clusters are opened in the same way
// as patches are split.
//
// Each pair has a list of its possible blockers (occlusion.hpp): a pair that is proven hidden is dropped along with all pairs below it.
//
// Invariant: after each generation every BRep is valid and every unordered pair of leaves that can face and see each other is
// covered by exactly one link or open pair between ancestors (or the leaves themselves).

#include <algorithm>
#include <cstddef>
#include <vector>

#include <raycast/shaft.hpp>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/oracle/importance.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/refine_result.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// 100 million links are 2.4 GB, and 3.6 GB while they are made of pairs; a scene that needs more is refused instead of exhausting the
// memory.
inline constexpr std::size_t link_limit = 100'000'000;

namespace detail {

// Decides about each pair in parallel: ask(p, q) gives the decision. Unless that drops the pair, its possible blockers are looked up; a
// pair that is proven hidden is dropped, others keep their list, and look(pair, list, decision) may change the decision. Without
// shortcuts, dropped pairs are linked instead, except for patches of one curved convex solid (plan.hpp).
template <class Ask, class Look>
std::vector<Decision> decide(const DiscreteScene& scene, NodePairs& pairs, RefineResult& result, const Ask& ask, const Look& look) {
  std::vector<Decision> decisions(pairs.size(), Decision::drop);
  const SceneView view = scene.view();
  constexpr std::size_t batch = 1 << 14;  // bounds the number of full lists in memory
  std::vector<raycast::OccluderList> lists(std::min(batch, pairs.size()));
  for (std::size_t first = 0; first < pairs.size(); first += batch) {
    const std::size_t count = std::min(batch, pairs.size() - first);
    parallel_for(count, scene.threads, [&](std::size_t k) {
      const NodePair& pair = pairs[first + k];
      Decision& decision = decisions[first + k];
      decision = ask(pair.p, pair.q);
      lists[k] = {};
      if (decision == Decision::drop || decision == Decision::convex) { return; }
      lists[k] = result.occluders.of(pair.p, pair.q, pair.list, view);
      if (lists[k].blocked()) {
        decision = Decision::hide;
      } else {
        look(first + k, lists[k], decision);
      }
    });
    for (std::size_t k = 0; k < count; ++k) {
      Decision& decision = decisions[first + k];
      const bool curved = scene.patches.is_curved(pairs[first + k].p) || scene.patches.is_curved(pairs[first + k].q);
      if (decision < first_seeing && !scene.plan.shortcuts && !(decision == Decision::convex && curved)) {
        decision = Decision::link;
        pairs[first + k].list = OccluderLists::hidden;
        continue;
      }
      result.pairs_dropped += decision == Decision::drop ? 1 : 0;
      result.pairs_convex += decision == Decision::convex ? 1 : 0;
      result.pairs_hidden += decision == Decision::hide ? 1 : 0;
      if (decision < first_seeing) { continue; }
      pairs[first + k].list = result.occluders.keep(lists[k], pairs[first + k].list);
    }
  }
  result.pairs_tested += pairs.size();
  return decisions;
}

}  // namespace detail

// How fine the links are. `min_area`: relative to the area of all roots that are not buried. If `light_epsilon` is 0 the light oracle is
// not asked.
struct Fineness {
  double epsilon = 0.0, min_area = 0.0;
  double light_epsilon = 0.0;        // relative to the reflected light
  double reflected = 1.0;            // RMS of the reflected light, relative to the mean emission
  AnyOracle oracle = FOracle{};      // for form factors
  Importance* importance = nullptr;  // weights for the picture of one camera, or null; extended to new nodes
};

// Builds the links of the hierarchy, splitting leaves as needed.
[[nodiscard]] RefineResult refine(DiscreteScene& scene, const Fineness& fineness, Linked linked = Linked::all);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/f_refine.cpp>
#endif
