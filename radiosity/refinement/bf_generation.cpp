// SPDX-License-Identifier: MIT
#include <radiosity/refinement/bf_generation.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/shaft.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/links/link_schedule.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/oracle/lit_faces.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/bf_goal.hpp>
#include <radiosity/refinement/closed_nodes.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/refinement/leaf_error.hpp>
#include <radiosity/refinement/link_error.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE BfState::BfState(DiscreteScene& of) : scene{of}, proofs{of.surfaces, of.hierarchy} {
  constexpr double first_epsilon = 0.25;
  links = MeasuredLinks(scene.budget.arrays);
  result.links = Links(scene.budget.arrays);
  result.refined = refine(scene, {first_epsilon, 1e-3, 0.0});
  for (const auto [p, q, list] : std::exchange(result.refined.linked, {})) { links.push_back({{p, q}, list, {}}); }
  min_area = 0x1p-24 * LitFaces{scene.view(), scene.reflectance, scene.emission, {}}.area();
  sees_itself.resize(scene.hierarchy.size(), false);
  for (const std::uint32_t i : result.refined.inner) { sees_itself[i] = true; }
}

HALFLIGHT_INLINE bool evaluate_generation(BfState& state) {
  DiscreteScene& scene = state.scene;
  BfResult& result = state.result;
  scene.expose();
  if (scene.clustered()) {
    ShownAreas now = scene.exposed_shown();
    for (std::size_t i = 0; i < state.measured; ++i) {
      Link& link = state.links[i].link;
      if (!scene.evaluator.between_patches(link)) { refit_cluster_link(scene.hierarchy, link, scene.shown, now); }
    }
    scene.shown = std::move(now);
  }
  result.evaluations += state.links.size() - state.measured;
  // Once there is a solution, a generation that has begun is completed, because a half-evaluated one is not a solution.
  const Control control = result.generations == 0 ? scene.control : scene.control.unstoppable();
  const EvaluateResult round =
      measure_links({scene.evaluator, result.refined.occluders, scene.threads, control}, state.links, state.measured);
  state.measured = state.links.size();
  result.evaluated.rays += round.rays;
  result.evaluated.proven_clear += round.proven_clear;
  result.evaluated.blocked += round.blocked;
  state.removed.add(round.doubt);
  result.evaluated.doubt = state.removed;
  for (const MeasuredLink& l : state.links) { result.evaluated.doubt.add(l.link.p, l.link.q, l.variation.doubt); }
  result.evaluated.cancelled = round.cancelled;
  if (!round.cancelled) { LinkSchedule::arrange(scene.hierarchy.size(), state.links); }
  return !round.cancelled;
}

HALFLIGHT_INLINE BfErrors estimate_errors(BfState& state, double leaf_part) {
  const DiscreteScene& scene = state.scene;
  BfResult& result = state.result;
  Links links(scene.budget.arrays);  // copied to a packed array, for the operator
  links.reserve(state.links.size());
  for (const MeasuredLink& l : state.links) { links.push_back(l.link); }
  Transport transport{scene.hierarchy, links, scene.exposure, scene.threads, closed_nodes(scene, links)};
  if (scene.any_closed()) { (void)transport.close(10.0, 1e-3); }
  const ColorSolution light = solve_channels(transport, transport.area(), surface_light(scene), {Solver::conjugate_gradients, 1e-3, 40});
  LeafErrors leaves = estimate_leaf_errors(scene, links, light.radiosity);
  BfErrors errors;
  errors.links = estimate_link_errors({std::nullopt, leaves.alike()}, scene, state.links, light.radiosity);
  errors.links.of_leaves = leaves.sum;
  errors.leaves = std::move(leaves.squares);
  for (float& e : errors.leaves) { e *= static_cast<float>(leaf_part * leaf_part); }
  errors.sum = errors.links.sum(leaf_part);
  result.estimate = errors.links.relative(leaf_part);
  result.leaf_estimate = errors.links.relative(1.0);
  result.unseen = errors.sum > 0.0 ? errors.links.unseen / errors.sum : 0.0;
  if (scene.budget.solved != nullptr) { *scene.budget.solved = result.generations + 1; }
  return errors;
}

// Pairs of children of what was split, about which the oracle has not been asked yet.
struct OpenPairs {
  explicit OpenPairs(std::pmr::memory_resource* arrays) : pairs(arrays) {}

  NodePairs pairs;
  std::vector<float> blocked;  // by pair, as in LinkVariation

  void add(const NodePair& pair, float segments) {
    pairs.push_back(pair);
    blocked.push_back(segments);
  }
};

// Splits the chosen leaves. The children of a concave curved face see each other.
HALFLIGHT_INLINE void split_leaves(BfState& state, const SplitChoice& choice, OpenPairs& open) {
  Hierarchy& hierarchy = state.scene.hierarchy;
  const auto before = static_cast<std::uint32_t>(hierarchy.size());
  state.stuck.resize(before, false);
  for (std::uint32_t i = 0; i < before; ++i) {
    if (!choice.asked[i] || !hierarchy[i].leaf()) { continue; }
    if (!subdivide(state.scene.surfaces, hierarchy, i, state.scene.meshing)) {
      state.stuck[i] = true;
      continue;
    }
    state.sees_itself.resize(hierarchy.size(), state.sees_itself[i]);
    if (!state.sees_itself[i]) { continue; }
    const std::uint32_t first = hierarchy[i].first_child, last = first + hierarchy[i].child_count;
    for (std::uint32_t a = first; a < last; ++a) {
      for (std::uint32_t b = a + 1; b < last; ++b) { open.add({a, b}, 0.0f); }
    }
  }
}

// Replaces the chosen links by pairs of children, and removes links without light whose squared error is at most `negligible`.
HALFLIGHT_INLINE void split_links(BfState& state, const std::vector<LinkError>& errors, const SplitChoice& choice, double negligible,
                                  OpenPairs& open) {
  const Hierarchy& hierarchy = state.scene.hierarchy;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < state.links.size(); ++i) {
    const Decision end = choice.ends[i];
    const auto& [link, list, variation] = state.links[i];
    if (end == Decision::link && !(link.exchange > 0.0f) && errors[i].sum() <= negligible) {
      state.removed.add(link.p, link.q, variation.doubt);
      ++state.result.evaluated.blocked;
      continue;
    }
    const std::uint32_t split = end == Decision::split_p ? link.p : link.q;
    const std::uint32_t other = end == Decision::split_p ? link.q : link.p;
    if (end == Decision::link || hierarchy[split].leaf()) {
      state.links[kept++] = state.links[i];
      continue;
    }
    const float segments = link.exchange > 0.0f ? 0.0f : variation.blocked + segments_per_round;
    for (std::uint32_t k = 0; k < hierarchy[split].child_count; ++k) {
      open.add({hierarchy[split].first_child + k, other, list}, segments * static_cast<float>(hierarchy[split].child_count));
    }
  }
  state.links.resize(kept);
  state.measured = kept;
}

// Makes links of the pairs that may see each other; the next generation measures them.
HALFLIGHT_INLINE void link_pairs(BfState& state, OpenPairs open) {
  const Hierarchy& hierarchy = state.scene.hierarchy;
  state.links.reserve(state.links.size() + open.pairs.size());
  while (!open.pairs.empty()) {
    const std::vector<Decision> decisions = decide(
        state.scene, open.pairs, state.result.refined,
        [&](std::uint32_t p, std::uint32_t q) {
          const Node& a = hierarchy[p];
          const Node& b = hierarchy[q];
          if (state.proofs.convex(a, b)) { return Decision::convex; }
          if (a.is_cluster() || b.is_cluster()) { return Decision::link; }
          return face_away(a, b) ? Decision::drop : f_rule(a, b, 1.0, state.min_area);
        },
        [](std::size_t, const raycast::OccluderList&, Decision&) {});
    OpenPairs parts{state.scene.budget.arrays};  // of faces from opened clusters that have too many parts to be linked
    for (std::size_t i = 0; i < open.pairs.size(); ++i) {
      if (decisions[i] < first_seeing) { continue; }
      const auto [p, q, list] = open.pairs[i];
      const std::uint32_t split = decisions[i] == Decision::split_p ? p : q;
      if (decisions[i] == Decision::link || !hierarchy[split].in_parts()) {
        state.links.push_back({{p, q}, list, {}});
        state.links.back().variation.blocked = open.blocked[i];
        continue;
      }
      for (std::uint32_t k = 0; k < hierarchy[split].child_count; ++k) {
        parts.add({hierarchy[split].first_child + k, split == p ? q : p, list}, open.blocked[i]);
      }
    }
    open = std::move(parts);
  }
}

HALFLIGHT_INLINE void split(BfState& state, const BfErrors& errors, const SplitChoice& choice, double allowed) {
  OpenPairs open{state.scene.budget.arrays};
  split_leaves(state, choice, open);
  const std::vector<LinkError>& of_links = errors.links.links;
  const auto carry = std::count_if(of_links.begin(), of_links.end(), [](const LinkError& e) { return e.sum() > 0.0f; });
  split_links(state, of_links, choice, 0.01 * allowed / static_cast<double>(carry), open);
  state.scene.patches.extend(state.scene.threads);
  link_pairs(state, std::move(open));
}

HALFLIGHT_INLINE BfResult finish(BfState& state) {
  Links& links = state.result.links;
  links.reserve(state.links.size());
  for (const MeasuredLink& l : state.links) {
    if (l.link.exchange > 0.0f) { links.push_back(l.link); }
  }
  state.result.evaluated.blocked += state.links.size() - links.size();
  return std::move(state.result);
}

}  // namespace detail

}  // namespace radiosity
