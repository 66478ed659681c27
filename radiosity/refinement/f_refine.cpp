// SPDX-License-Identifier: MIT
#include <radiosity/refinement/f_refine.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/shaft.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/oracle/lamp_oracle.hpp>
#include <radiosity/oracle/light_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/oracle/proof_oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/first_pairs.hpp>
#include <radiosity/refinement/measured_light.hpp>
#include <radiosity/refinement/whole_lamps.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

// Which roots send light: those that emit, and, repeatedly, those that reflect and may be linked to one that sends.
HALFLIGHT_INLINE std::vector<bool> sending_roots(const DiscreteScene& scene, const NodePairs& pairs,
                                                 const std::vector<Decision>& decisions) {
  const Hierarchy& roots = scene.hierarchy;
  std::vector<bool> sends(roots.size(), false), reflects(roots.size(), false);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    sends[i] = roots[i].is_cluster() || !is_black(scene.emission[roots[i].surface]);  // a cluster, as only lamps have
    reflects[i] = !roots[i].is_cluster() && !is_black(scene.reflectance[roots[i].surface]);
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

// Largest variation of a lamp's light, relative to the mean emission.
[[nodiscard]] HALFLIGHT_INLINE double light_epsilon_of_emission(const Fineness& to) { return to.reflected * to.light_epsilon; }

// The factor, at most 1, by which light is resolved finer than epsilon alone requires. Dim reflected light contributes at most a factor
// of 2, because light through a pinhole varies everywhere by more than its own value and would be refined endlessly.
[[nodiscard]] HALFLIGHT_INLINE double finer_for_light(const Fineness& to) {
  const double dim = std::max(0.5, to.reflected);
  return std::min(1.0, dim * to.light_epsilon / (0.25 * to.epsilon));
}

// A patch of up to this many times the least area is not split for the form factor of a pair, because its quarters would be smaller than
// that. Close pairs in corners and at contacts would be most of all links if all of them went down to the least area, with hardly any
// gain: by measurement, a factor of four gives half of the links and the same error, and the light of lamps still splits leaves below it.
inline constexpr double largest_linked = 4.0;

// The state of F-refinement between two generations.
struct FRefinement {
  FRefinement(DiscreteScene& of, const Fineness& to)
      : scene{of},
        fineness{to},
        proofs{of.surfaces, of.hierarchy},
        shown{of.hierarchy, [&](std::size_t i) { return of.hierarchy[i].area; }},
        light{of.input, of.view(), shown, light_epsilon_of_emission(to), of.seed, proofs.buried()},
        min_area{largest_linked * to.min_area * light.scene_area()},
        light_min_area{0.25 * to.min_area * light.scene_area() * finer_for_light(to) * finer_for_light(to)},
        measured{of, proofs.buried(), light.scene_area(), to.light_epsilon, light_min_area / 16.0},
        whole_lamps{of.hierarchy},
        pairs(of.budget.arrays) {
    result.linked = NodePairs(of.budget.arrays);
    result.occluders = OccluderLists(of.budget.arrays);
  }

  // May so many links be made? If not, result.too_many is set.
  [[nodiscard]] bool few_enough(std::uint64_t links) {
    if (links > link_limit) { result.too_many = links; }
    return result.too_many == 0;
  }
  [[nodiscard]] bool fits(std::uint64_t nodes, std::uint64_t links, std::uint64_t open) {
    const MemoryBudget::Counts counts{nodes, links, open, result.occluders.bytes()};
    if (!scene.budget.allows(counts)) { result.too_large = scene.budget.peak(counts); }
    return result.too_large == 0;
  }

  [[nodiscard]] double weight(std::uint32_t i) const { return fineness.importance != nullptr ? fineness.importance->weight(i) : 1.0; }
  // Least areas of leaves that are split: for the light of lamps, and for the form factor of a pair.
  [[nodiscard]] double light_min_area_of(std::uint32_t i) const { return light_min_area / weight(i); }
  [[nodiscard]] double min_area_of(std::uint32_t p, std::uint32_t q) const { return min_area / std::max(weight(p), weight(q)); }

  DiscreteScene& scene;
  Fineness fineness;
  ProofOracle proofs;
  ShownAreas shown;  // of the clusters, by the whole area of their faces
  LightOracle light;
  double min_area;  // of a leaf that is split for a form factor, in squared units of the frame
  double light_min_area;
  MeasuredLight measured;
  WholeLamps whole_lamps;
  NodePairs pairs;                 // open pairs
  std::vector<bool> stuck;         // leaves that the BRep refused to split
  std::uint32_t nodes_before = 0;  // at the beginning of split_leaves()
  RefineResult result;
};

// Replaces the answer of an oracle by `link` if a leaf would be split although neither end is larger than min_area.
[[nodiscard]] HALFLIGHT_INLINE Decision within_min_area(const Question& question, Decision answer) {
  if (answer != Decision::split_p && answer != Decision::split_q) { return answer; }
  const Node& split = answer == Decision::split_p ? question.node_p() : question.node_q();
  const bool small = std::max(question.node_p().area, question.node_q().area) <= question.min_area;
  return split.leaf() && small ? Decision::link : answer;
}

// Is this a patch that reflects nothing and is larger than all that reflects, such as a side of a black sky? Two of them are linked without
// splitting, because nothing of the light between them is seen; otherwise they would be split down to the smallest patches.
[[nodiscard]] HALFLIGHT_INLINE bool of_black_sky(const FRefinement& state, std::uint32_t i) {
  const Node& node = state.scene.hierarchy[i];
  return !node.is_cluster() && node.area > state.light.scene_area() && is_black(state.scene.reflectance[node.surface]);
}

// The decision about each open pair; meaningless after cancellation.
HALFLIGHT_INLINE std::vector<Decision> ask_oracles(FRefinement& state) {
  DiscreteScene& scene = state.scene;
  scene.patches.extend(scene.threads);
  if (state.fineness.importance != nullptr) { state.fineness.importance->extend(scene.hierarchy, scene.patches); }
  state.measured.measure(state.pairs);
  std::vector<RayCount> rays(state.pairs.size());
  std::vector<Decision> decisions = decide(
      scene, state.pairs, state.result,
      [&](std::uint32_t p, std::uint32_t q) {
        if (scene.control.cancelled()) { return Decision::drop; }
        const Question question{scene.hierarchy, p, q, state.shown, state.fineness.epsilon, state.min_area_of(p, q), &state.stuck};
        const Decision proven = state.proofs(question);
        if (state.measured.takes_whole_lamp({p, q})) { return proven; }
        if (proven != Decision::link) { return proven; }
        if (of_black_sky(state, p) && of_black_sky(state, q)) { return Decision::link; }
        const bool of_lamps = !scene.clustered() && (scene.hierarchy[p].is_cluster() || scene.hierarchy[q].is_cluster());
        return within_min_area(question, of_lamps ? LampOracle{}(question) : state.fineness.oracle(question));
      },
      [&](std::size_t i, const raycast::OccluderList& list, Decision& decision) {
        const NodePair& pair = state.pairs[i];
        if (!(state.fineness.light_epsilon > 0.0)) { return; }
        const bool opens_lamp = state.whole_lamps.opens(pair, decision);
        if ((decision != Decision::link && !opens_lamp) || state.whole_lamps.settled(pair)) { return; }
        Question question{scene.hierarchy, pair.p, pair.q, state.shown, light_epsilon_of_emission(state.fineness)};
        if (opens_lamp && state.whole_lamps.reaches_in(pair)) {
          question.min_area = state.min_area_of(pair.p, pair.q);
          question.stuck = &state.stuck;
          decision = state.whole_lamps.split_within(question, decision);
          return;
        }
        question.min_area = state.light_min_area;
        question.between = &list;
        question.rays = &rays[i];
        question.importance = state.fineness.importance;
        const bool measured = state.measured.receiver(pair) != no_node;
        const Decision answer = measured ? state.measured(pair) : state.light(question);
        if (!opens_lamp || answer != Decision::link) { decision = answer; }
      });
  for (const RayCount& r : rays) { state.result.rays += r; }
  state.whole_lamps.settle(state.pairs, decisions);
  return decisions;
}

// Drops pairs of input faces that send no light. A closed scene keeps them, for its row sums.
HALFLIGHT_INLINE void drop_dark_pairs(FRefinement& state, std::vector<Decision>& decisions) {
  const bool shortcuts = state.scene.plan.shortcuts;
  const std::vector<bool> sends = sending_roots(state.scene, state.pairs, decisions);
  for (std::size_t i = 0; i < state.pairs.size(); ++i) {
    if (sends[state.pairs[i].p] || sends[state.pairs[i].q] || decisions[i] < first_seeing) { continue; }
    state.result.pairs_dark += shortcuts ? 1 : 0;
    decisions[i] = shortcuts ? Decision::drop : Decision::link;
  }
  std::erase_if(state.result.inner, [&](std::uint32_t i) { return !sends[i]; });
}

HALFLIGHT_INLINE void tell(const FRefinement& state, const std::vector<Decision>& decisions) {
  for (std::size_t i = 0; i < state.pairs.size(); ++i) {
    const NodePair& pair = state.pairs[i];
    state.scene.control.decided(
        {state.scene.hierarchy, pair.p, pair.q, state.shown, state.fineness.epsilon, state.min_area_of(pair.p, pair.q), &state.stuck},
        decisions[i]);
  }
}

// Splits the leaves that any pair has requested, in the order of their index. Returns false, without splitting, if the memory does not
// suffice.
[[nodiscard]] HALFLIGHT_INLINE bool split_leaves(FRefinement& state, const std::vector<Decision>& decisions) {
  Hierarchy& hierarchy = state.scene.hierarchy;
  std::vector<bool> asked(hierarchy.size(), false);
  state.stuck.resize(hierarchy.size(), false);
  for (std::size_t i = 0; i < state.pairs.size(); ++i) {
    if (decisions[i] == Decision::split_p) { asked[state.pairs[i].p] = true; }
    if (decisions[i] == Decision::split_q) { asked[state.pairs[i].q] = true; }
  }
  const std::uint32_t before = state.nodes_before = static_cast<std::uint32_t>(hierarchy.size());
  std::uint64_t nodes = before;
  for (std::uint32_t i = 0; i < before; ++i) { nodes += asked[i] && hierarchy[i].leaf() ? hierarchy[i].corners : 0; }
  if (!state.fits(nodes, state.result.linked.size(), state.pairs.size())) { return false; }
  for (std::uint32_t i = 0; i < before; ++i) {
    if (asked[i] && hierarchy[i].leaf() && !subdivide(state.scene.surfaces, hierarchy, i, state.scene.meshing)) { state.stuck[i] = true; }
  }
  return true;
}

// Must the oracle be asked again about this link? Yes, if its small end has just been split for another lamp or for another face of the
// same one. The light of one face rises where that of the next falls; if only one of them were resolved, their sum would become less
// accurate.
[[nodiscard]] HALFLIGHT_INLINE bool asked_again(const FRefinement& state, const NodePair& pair, Decision decision) {
  const Hierarchy& nodes = state.scene.hierarchy;
  const auto split_now = [&](std::uint32_t i) {
    return !nodes[i].leaf() && nodes[i].first_child >= state.nodes_before && !(nodes[i].area > state.light_min_area_of(i));
  };
  const auto shines = [&](const Node& by) { return !is_black(state.scene.emission[by.surface]); };
  const Node &p = nodes[pair.p], &q = nodes[pair.q];
  if (decision != Decision::link || p.is_cluster() || q.is_cluster()) { return false; }
  return (split_now(pair.p) && shines(q)) || (split_now(pair.q) && shines(p));
}

// The number of pairs in the next generation; nothing if these, or the links made now, exceed a limit.
[[nodiscard]] HALFLIGHT_INLINE std::optional<std::uint64_t> count_opened(FRefinement& state, const std::vector<Decision>& decisions) {
  const Hierarchy& hierarchy = state.scene.hierarchy;
  std::uint64_t links = state.result.linked.size(), opened = 0;
  for (std::size_t i = 0; i < state.pairs.size(); ++i) {
    const bool again = asked_again(state, state.pairs[i], decisions[i]);
    links += decisions[i] == Decision::link && !again ? 1 : 0;
    opened += again ? 1 : 0;
    if (decisions[i] != Decision::split_p && decisions[i] != Decision::split_q) { continue; }
    const std::uint64_t children = hierarchy[decisions[i] == Decision::split_p ? state.pairs[i].p : state.pairs[i].q].child_count;
    opened += state.pairs[i].p == state.pairs[i].q ? children * (children + 1) / 2 : children;
  }
  if (!state.few_enough(links + opened) || !state.fits(hierarchy.size(), links, state.pairs.size() + opened)) { return std::nullopt; }
  return opened;
}

// Adds the pairs of the children of `split` with the other node, or with each other if both are the same.
HALFLIGHT_INLINE void descend(const Hierarchy& hierarchy, std::uint32_t split, std::uint32_t other, std::uint32_t list, NodePairs& pairs) {
  const std::uint32_t first = hierarchy[split].first_child;
  const std::uint32_t last = first + hierarchy[split].child_count;
  for (std::uint32_t a = first; a < last; ++a) {
    if (split != other) {
      pairs.push_back({a, other, list});
      continue;
    }
    // A cluster with itself: all pairs of its children, and child clusters with themselves.
    for (std::uint32_t b = hierarchy[a].is_cluster() ? a : a + 1; b < last; ++b) { pairs.push_back({a, b}); }
  }
}

// Links the pairs for which that was decided, keeps those that are asked about again, and replaces split ones by the pairs of the children.
HALFLIGHT_INLINE void link_or_descend(FRefinement& state, const std::vector<Decision>& decisions, NodePairs& next) {
  const Hierarchy& hierarchy = state.scene.hierarchy;
  for (std::size_t i = 0; i < state.pairs.size(); ++i) {
    const auto [p, q, list] = state.pairs[i];
    if (decisions[i] < first_seeing) { continue; }
    bool split_p = decisions[i] == Decision::split_p && !state.stuck[p];
    bool split_q = decisions[i] == Decision::split_q && !state.stuck[q];
    if (decisions[i] != Decision::link && !split_p && !split_q) {  // stuck: split the other end if that is a cluster
      split_p = hierarchy[p].is_cluster();
      split_q = hierarchy[q].is_cluster();
    }
    if (split_p || split_q) {
      split_p ? descend(hierarchy, p, q, list, next) : descend(hierarchy, q, p, list, next);
    } else {
      (asked_again(state, state.pairs[i], decisions[i]) ? next : state.result.linked).push_back(state.pairs[i]);
    }
  }
}

// The children of a concave curved face see each other, so their pairs are added.
HALFLIGHT_INLINE void descend_inner(FRefinement& state, NodePairs& next) {
  const Hierarchy& hierarchy = state.scene.hierarchy;
  std::vector<std::uint32_t> still_inner;
  for (const std::uint32_t p : state.result.inner) {
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
  state.result.inner = std::move(still_inner);
}

}  // namespace detail

HALFLIGHT_INLINE RefineResult refine(DiscreteScene& scene, const Fineness& fineness, Linked linked) {
  scene.patches.extend(scene.threads);
  detail::FRefinement state{scene, fineness};
  RefineResult& result = state.result;
  const std::uint64_t on_top = detail::tops(scene.hierarchy).size();
  const std::uint64_t all_pairs = scene.clustered() || linked == Linked::lamps ? 0 : on_top * on_top / 2;
  if (!state.few_enough(all_pairs) || !state.fits(scene.hierarchy.size(), 0, scene.clustered() ? 1 : all_pairs)) {
    return std::move(result);
  }
  detail::first_pairs(scene, state.proofs, linked, state.pairs, result);
  while (!state.pairs.empty()) {
    result.cancelled = scene.control.cancelled();
    if (result.cancelled || !state.few_enough(result.linked.size() + state.pairs.size())) { break; }
    std::vector<Decision> decisions = detail::ask_oracles(state);
    result.cancelled = scene.control.cancelled();
    if (result.cancelled) { break; }
    if (result.generations == 0 && !scene.plan.closed && !scene.clustered() && linked == Linked::all) {
      detail::drop_dark_pairs(state, decisions);
    }
    if (scene.control.decided) { detail::tell(state, decisions); }
    if (!detail::split_leaves(state, decisions)) { break; }
    const std::optional<std::uint64_t> opened = detail::count_opened(state, decisions);
    if (!opened) { break; }
    NodePairs next(scene.budget.arrays);
    next.reserve(*opened);
    detail::link_or_descend(state, decisions, next);
    detail::descend_inner(state, next);
    state.pairs = std::move(next);
    ++result.generations;
    if (scene.control.after_generation) { scene.control.after_generation(scene.surfaces); }
    scene.control.report("refine", state.pairs.empty() ? 1.0 : 1.0 - 1.0 / (1.0 + result.generations));
  }
  return std::move(result);
}

}  // namespace radiosity
