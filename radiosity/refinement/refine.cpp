// SPDX-License-Identifier: MIT
#include <radiosity/refinement/refine.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <raycast/inline.hpp>
#include <raycast/shaft.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/oracle/light_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/oracle/pair_oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

// Where refinement begins: with the pair of the root cluster with itself, or all pairs of input faces. In `inner` the input faces whose own
// parts may face each other.
HALFLIGHT_INLINE void first_pairs(const DiscreteScene& scene, const PairOracle& oracle, std::vector<Pair>& pairs, RefineResult& result) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const auto count = static_cast<std::uint32_t>(hierarchy.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_input_face(hierarchy, i) || oracle.buried(i)) { continue; }
    const raycast::PlacedObject& object = *scene.surfaces[hierarchy[i].object].object;
    if ((object.inside() || !object.convex()) && !object.flat()) { result.inner.push_back(i); }
  }
  if (scene.clustered()) {
    pairs.push_back({0, 0});
    return;
  }
  for (std::uint32_t p = 0; p < count; ++p) {
    if (!is_input_face(hierarchy, p)) { continue; }
    for (std::uint32_t q = p + 1; q < count; ++q) {
      if (!is_input_face(hierarchy, q)) { continue; }
      if (!oracle.convex(hierarchy[p], hierarchy[q])) {
        pairs.push_back({p, q});
      } else if (scene.plan.shortcuts || hierarchy[p].deviation > 0.0 || hierarchy[q].deviation > 0.0) {
        ++result.pairs_convex;
      } else {
        result.links.push_back({p, q});
        result.lists.push_back(OccluderLists::hidden);
      }
    }
  }
}

// Which roots send light: those that emit, and those that reflect and are reached, over pairs that may be linked, from one that sends.
HALFLIGHT_INLINE std::vector<bool> sending_roots(const DiscreteScene& scene, const std::vector<Pair>& pairs,
                                                 const std::vector<Decision>& decisions) {
  const Hierarchy& roots = scene.hierarchy;
  std::vector<bool> sends(roots.size(), false), reflects(roots.size(), false);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    sends[i] = !is_black(scene.emission[roots[i].surface]);
    reflects[i] = !is_black(scene.reflectance[roots[i].surface]);
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

HALFLIGHT_INLINE RefineResult refine(DiscreteScene& scene, const Fineness& fineness) {
  const Plan& plan = scene.plan;
  const Control& control = scene.control;
  Hierarchy& hierarchy = scene.hierarchy;
  RefineResult result;
  const PairOracle oracle{scene.surfaces, hierarchy};
  const LightOracle light{scene.input,    scene.objects,          plan,       scene.patches,  hierarchy,
                          oracle.shown(), fineness.light_epsilon, scene.seed, oracle.buried()};
  const double min_area = fineness.min_area * light.scene_area();
  const double finer = std::min(1.0, fineness.light_epsilon / (0.25 * fineness.epsilon));
  const double light_min_area = 0.25 * min_area * finer * finer;
  std::vector<RayCount> rays;

  const bool clustered = scene.clustered();
  if (!clustered && hierarchy.size() * hierarchy.size() / 2 > link_limit) {
    result.too_many = hierarchy.size() * hierarchy.size() / 2;
    return result;
  }
  // Whether so many may be made; if not, the result says what they would need.
  const auto fits = [&](std::uint64_t nodes, std::uint64_t links, std::uint64_t open) {
    const MemoryBudget::Counts counts{nodes, links, open, result.occluders.bytes()};
    if (!scene.budget.allows(counts)) { result.too_large = scene.budget.peak(counts); }
    return result.too_large == 0;
  };
  if (!fits(hierarchy.size(), 0, clustered ? 1 : hierarchy.size() * hierarchy.size() / 2)) { return result; }
  std::vector<detail::Pair> pairs;
  std::vector<std::uint32_t>& inner = result.inner;
  detail::first_pairs(scene, oracle, pairs, result);

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
    scene.patches.extend(scene.threads);
    rays.assign(pairs.size(), {});
    std::vector<Decision> decisions = detail::decide(
        scene, pairs, result, [&](std::uint32_t p, std::uint32_t q) { return oracle(p, q, fineness.epsilon, min_area); },
        [&](std::size_t i, const raycast::OccluderList& list, Decision& decision) {
          const auto [p, q, index] = pairs[i];
          if (decision != Decision::link || !(fineness.light_epsilon > 0.0)) { return; }
          const std::uint32_t split = light.wants_split(p, q, list, rays[i]);
          if (split != no_node && hierarchy[split].area > light_min_area) { decision = split == p ? Decision::split_p : Decision::split_q; }
        });
    for (const RayCount& r : rays) { result.rays += r; }

    // No light passes between two that send none. A closed scene keeps such pairs, for its row sums.
    if (result.generations == 0 && !plan.closed && !clustered) {
      const std::vector<bool> sends = detail::sending_roots(scene, pairs, decisions);
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
      if (asked[i] && hierarchy[i].leaf() && !subdivide(scene.surfaces, hierarchy, i)) { stuck[i] = true; }
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
    if (control.after_generation) { control.after_generation(scene.surfaces); }
    control.report("refine", pairs.empty() ? 1.0 : 1.0 - 1.0 / (1.0 + result.generations));
  }
  return result;
}

}  // namespace radiosity
