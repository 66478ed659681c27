// SPDX-License-Identifier: MIT
#pragma once

// F-refinement (paper 4.4): every pair of input faces is linked where the oracle allows, and patches are split where it does
// not; where a light shines, the light oracle is asked as well. The work goes generation by generation: the oracles answer
// for all open pairs in parallel, then links and splits are carried out in the order of the pairs and of the nodes. So the
// result is the same for any number of threads, and a split asked for by many pairs happens once.
//
// Where there are clusters (clusters.hpp) the work begins with the pair of their root with itself, and clusters are opened as patches are
// split.
//
// Each pair knows what can stand between its patches (occlusion.hpp): a pair that is proven hidden is dropped with all pairs below it.
//
// Invariant: after each generation every BRep is valid and every unordered pair of leaves that can face and see each other is
// covered by exactly one link or open pair between ancestors (or the leaves themselves).

#include <cstdint>
#include <utility>
#include <vector>

#include <radiosity/hierarchy.hpp>
#include <radiosity/light_oracle.hpp>
#include <radiosity/links.hpp>
#include <radiosity/memory.hpp>
#include <radiosity/occlusion.hpp>
#include <radiosity/options.hpp>
#include <radiosity/oracle.hpp>
#include <radiosity/pair_oracle.hpp>
#include <radiosity/parallel.hpp>
#include <radiosity/plan.hpp>
#include <radiosity/surface.hpp>

namespace radiosity {

struct RefineResult {
  Links links;                       // without their exchange
  std::vector<std::uint32_t> lists;  // of each link: the index of its list of occluders
  OccluderLists occluders;
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

// 100 million links are 2.4 GB, and 2.8 GB until they are evaluated; a scene that asks for more is refused rather than left to exhaust
// the memory.
inline constexpr std::size_t link_limit = 100'000'000;

namespace detail {

struct Pair {
  std::uint32_t p, q;
  std::uint32_t list = OccluderLists::none;  // of the pair, or of the pair of ancestors from which it comes
};

// Where refinement begins: with the pair of the root cluster with itself, or all pairs of input faces. In `inner` the input faces whose own
// parts may face each other.
inline void first_pairs(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy, const Plan& plan, const PairOracle& oracle,
                        std::vector<Pair>& pairs, RefineResult& result) {
  const auto count = static_cast<std::uint32_t>(hierarchy.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_input_face(hierarchy, i) || oracle.buried(i)) { continue; }
    const raycast::PlacedObject& object = *surfaces[hierarchy[i].object].object;
    if ((object.inside() || !object.convex()) && !object.flat()) { result.inner.push_back(i); }
  }
  if (count > 0 && hierarchy[0].is_cluster()) {
    pairs.push_back({0, 0});
    return;
  }
  for (std::uint32_t p = 0; p < count; ++p) {
    if (!is_input_face(hierarchy, p)) { continue; }
    for (std::uint32_t q = p + 1; q < count; ++q) {
      if (!is_input_face(hierarchy, q)) { continue; }
      if (!oracle.convex(hierarchy[p], hierarchy[q])) {
        pairs.push_back({p, q});
      } else if (plan.shortcuts || hierarchy[p].deviation > 0.0 || hierarchy[q].deviation > 0.0) {
        ++result.pairs_convex;
      } else {
        result.links.push_back({p, q});
        result.lists.push_back(OccluderLists::hidden);
      }
    }
  }
}

// Asks `oracle(p, q)` what to do with each pair and, unless it drops the pair, looks at what can stand between: hidden pairs are dropped,
// the others keep their list and are shown to `look(pair, list, decision)`, in parallel. Without shortcuts what would be dropped is linked,
// but for patches of one curved convex solid (plan.hpp).
template <class Oracle, class Look>
std::vector<Decision> decide(std::vector<Pair>& pairs, const raycast::Scene& objects, const Plan& plan, const Patches& patches,
                             RefineResult& result, unsigned threads, const Oracle& oracle, const Look& look) {
  std::vector<Decision> decisions(pairs.size(), Decision::drop);
  constexpr std::size_t batch = 1 << 14;  // lists of full length that live at a time
  std::vector<raycast::OccluderList> lists(std::min(batch, pairs.size()));
  for (std::size_t first = 0; first < pairs.size(); first += batch) {
    const std::size_t count = std::min(batch, pairs.size() - first);
    parallel_for(count, threads, [&](std::size_t k) {
      const Pair& pair = pairs[first + k];
      Decision& decision = decisions[first + k];
      decision = oracle(pair.p, pair.q);
      lists[k] = {};
      if (decision == Decision::drop || decision == Decision::convex) { return; }
      lists[k] = result.occluders.of(pair.p, pair.q, pair.list, objects, plan, patches);
      if (lists[k].blocked()) {
        decision = Decision::hide;
      } else {
        look(first + k, lists[k], decision);
      }
    });
    for (std::size_t k = 0; k < count; ++k) {
      Decision& decision = decisions[first + k];
      const bool curved = patches.is_curved(pairs[first + k].p) || patches.is_curved(pairs[first + k].q);
      if (decision < first_seeing && !plan.shortcuts && !(decision == Decision::convex && curved)) {
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

// Which roots send light: those that emit, and those that reflect and are reached, over pairs that may be linked, from one that sends.
inline std::vector<bool> sending_roots(const Scene& scene, const Hierarchy& roots, const std::vector<Pair>& pairs,
                                       const std::vector<Decision>& decisions) {
  std::vector<bool> sends(roots.size(), false), reflects(roots.size(), false);
  const std::vector<InputSurface> inputs = radiosity::surfaces(scene);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const Material& material = scene.materials[inputs[roots[i].surface].material];
    sends[i] = !is_black(material.emission);
    reflects[i] = !is_black(material.reflectance);
  }
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [p, q, list] = pairs[i];
      if (decisions[i] < first_seeing || sends[p] == sends[q]) { continue; }
      const std::uint32_t reached = sends[p] ? q : p;
      if (reflects[reached]) { sends[reached] = grew = true; }
    }
  }
  return sends;
}

}  // namespace detail

// Builds the links of the hierarchy, splitting leaves as needed. `min_area` is relative to the area of all roots that are not
// buried. `light_epsilon`: of the light
// oracle, which is not asked when it is 0.
[[nodiscard]] inline RefineResult refine(const Scene& scene, const raycast::Scene& objects, const Plan& plan,
                                         std::vector<Surface>& surfaces, Hierarchy& hierarchy, Patches& patches, double epsilon,
                                         double min_area, double light_epsilon, unsigned threads, std::uint64_t seed,
                                         const Control& control = {}, const MemoryBudget& budget = {}) {
  RefineResult result;
  const PairOracle oracle{surfaces, hierarchy};
  const LightOracle light{scene, objects, plan, patches, hierarchy, oracle.shown(), light_epsilon, seed, oracle.buried()};
  min_area *= light.scene_area();
  const double finer = std::min(1.0, light_epsilon / (0.25 * epsilon));
  const double light_min_area = 0.25 * min_area * finer * finer;
  std::vector<RayCount> rays;

  const bool clustered = !hierarchy.empty() && hierarchy[0].is_cluster();
  if (!clustered && hierarchy.size() * hierarchy.size() / 2 > link_limit) {
    result.too_many = hierarchy.size() * hierarchy.size() / 2;
    return result;
  }
  // Whether so many may be made; if not, the result says what they would need.
  const auto fits = [&](std::uint64_t nodes, std::uint64_t links, std::uint64_t open) {
    const MemoryBudget::Counts counts{nodes, links, open, result.occluders.bytes()};
    if (!budget.allows(counts)) { result.too_large = budget.peak(counts); }
    return result.too_large == 0;
  };
  if (!fits(hierarchy.size(), 0, clustered ? 1 : hierarchy.size() * hierarchy.size() / 2)) { return result; }
  std::vector<detail::Pair> pairs;
  std::vector<std::uint32_t>& inner = result.inner;
  detail::first_pairs(surfaces, hierarchy, plan, oracle, pairs, result);

  std::vector<bool> stuck;  // leaves that the BRep refused to split
  while (!pairs.empty()) {
    if (control.cancelled()) {
      result.cancelled = true;
      return result;
    }
    if (result.links.size() + pairs.size() > link_limit) {
      result.too_many = result.links.size() + pairs.size();
      return result;
    }
    patches.extend(threads);
    rays.assign(pairs.size(), {});
    std::vector<Decision> decisions = detail::decide(
        pairs, objects, plan, patches, result, threads, [&](std::uint32_t p, std::uint32_t q) { return oracle(p, q, epsilon, min_area); },
        [&](std::size_t i, const raycast::OccluderList& list, Decision& decision) {
          const auto [p, q, index] = pairs[i];
          if (decision != Decision::link || !(light_epsilon > 0.0)) { return; }
          const std::uint32_t split = light.wants_split(p, q, list, rays[i]);
          if (split != no_node && hierarchy[split].area > light_min_area) { decision = split == p ? Decision::split_p : Decision::split_q; }
        });
    for (const RayCount& r : rays) { result.rays += r; }

    // No light passes between two that send none. A closed scene keeps such pairs, for its row sums.
    if (result.generations == 0 && !plan.closed && !clustered) {
      const std::vector<bool> sends = detail::sending_roots(scene, hierarchy, pairs, decisions);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (sends[pairs[i].p] || sends[pairs[i].q] || decisions[i] < first_seeing) { continue; }
        result.pairs_dark += plan.shortcuts ? 1 : 0;
        decisions[i] = plan.shortcuts ? Decision::drop : Decision::link;
      }
      std::erase_if(inner, [&](std::uint32_t i) { return !sends[i]; });
    }

    // Leaves are split in the order of their index.
    std::vector<bool> asked(hierarchy.size(), false);
    stuck.resize(hierarchy.size(), false);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (decisions[i] == Decision::split_p) { asked[pairs[i].p] = true; }
      if (decisions[i] == Decision::split_q) { asked[pairs[i].q] = true; }
    }
    const auto before = static_cast<std::uint32_t>(hierarchy.size());
    std::uint64_t nodes = before;
    for (std::uint32_t i = 0; i < before; ++i) { nodes += asked[i] && hierarchy[i].leaf() ? hierarchy[i].corners : 0; }
    if (!fits(nodes, result.links.size(), pairs.size())) { return result; }
    for (std::uint32_t i = 0; i < before; ++i) {
      if (asked[i] && hierarchy[i].leaf() && !subdivide(surfaces, hierarchy, i)) { stuck[i] = true; }
    }

    std::uint64_t linked = 0, opened = 0;  // links that are made now, pairs that the next generation will have
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      linked += decisions[i] == Decision::link ? 1 : 0;
      if (decisions[i] != Decision::split_p && decisions[i] != Decision::split_q) { continue; }
      const std::uint64_t children = hierarchy[decisions[i] == Decision::split_p ? pairs[i].p : pairs[i].q].child_count;
      opened += pairs[i].p == pairs[i].q ? children * (children + 1) / 2 : children;
    }
    if (result.links.size() + linked + opened > link_limit) {  // before the memory for them is asked for
      result.too_many = result.links.size() + linked + opened;
      return result;
    }
    if (!fits(hierarchy.size(), result.links.size() + linked, pairs.size() + opened)) { return result; }
    std::vector<detail::Pair> next;
    next.reserve(opened);
    const auto descend = [&](std::uint32_t split, std::uint32_t other, std::uint32_t list) {
      const std::uint32_t first = hierarchy[split].first_child;
      const std::uint32_t last = first + hierarchy[split].child_count;
      for (std::uint32_t a = first; a < last; ++a) {
        if (split != other) {
          next.push_back({a, other, list});
          continue;
        }
        // A cluster with itself: all pairs of its children, and the clusters among them with themselves.
        for (std::uint32_t b = hierarchy[a].is_cluster() ? a : a + 1; b < last; ++b) { next.push_back({a, b}); }
      }
    };
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [p, q, list] = pairs[i];
      if (decisions[i] < first_seeing) { continue; }
      bool split_p = decisions[i] == Decision::split_p && !stuck[p];
      bool split_q = decisions[i] == Decision::split_q && !stuck[q];
      if (decisions[i] != Decision::link && !split_p && !split_q) {  // stuck: up to the other, if that is a cluster
        split_p = hierarchy[p].is_cluster();
        split_q = hierarchy[q].is_cluster();
      }
      if (split_p || split_q) {
        split_p ? descend(p, q, list) : descend(q, p, list);
      } else {
        result.links.push_back({p, q});
        result.lists.push_back(list);
      }
    }
    std::vector<std::uint32_t> still_inner;
    for (const std::uint32_t p : inner) {
      if (hierarchy[p].leaf()) {
        still_inner.push_back(p);
        continue;
      }
      const std::uint32_t first = hierarchy[p].first_child;
      const std::uint32_t last = first + hierarchy[p].child_count;
      for (std::uint32_t a = first; a < last; ++a) {
        still_inner.push_back(a);
        for (std::uint32_t b = a + 1; b < last; ++b) { next.push_back({a, b}); }
      }
    }
    inner = std::move(still_inner);
    pairs = std::move(next);
    ++result.generations;
    if (control.after_generation) { control.after_generation(surfaces); }
    control.report("refine", pairs.empty() ? 1.0 : 1.0 - 1.0 / (1.0 + result.generations));
  }
  return result;
}

}  // namespace radiosity
