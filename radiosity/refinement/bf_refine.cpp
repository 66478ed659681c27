// SPDX-License-Identifier: MIT
#include <radiosity/refinement/bf_refine.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <raycast/inline.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/links/link_schedule.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/oracle/pair_oracle.hpp>
#include <radiosity/refinement/leaf_error.hpp>
#include <radiosity/refinement/link_error.hpp>
#include <radiosity/refinement/refine.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

// The least error of a link or a leaf that is to be refined: those above it hold all of the sum but `keep`, within a factor of sqrt 2.
HALFLIGHT_INLINE double refinement_threshold(const std::vector<float>& links, const std::vector<float>& leaves, double keep) {
  constexpr int half_octaves = 512;
  std::array<double, half_octaves> held{};
  const auto bin = [](double error) {
    return std::clamp(static_cast<int>(std::floor(2.0 * std::log2(error))) + half_octaves / 2, 0, half_octaves - 1);
  };
  const auto count = [&](float error) {
    if (error > 0.0f) { held[static_cast<std::size_t>(bin(error))] += error; }
  };
  for (const float e : links) { count(e); }
  for (const float e : leaves) { count(e); }
  double sum = 0.0;
  int b = 0;
  while (b < half_octaves && (sum += held[static_cast<std::size_t>(b)]) <= keep) { ++b; }
  return std::exp2((b - half_octaves / 2) / 2.0);
}

// The error of the link of this rank, largest first; 0 beyond the last.
HALFLIGHT_INLINE double error_of_rank(const std::vector<LinkError>& errors, std::size_t rank) {
  if (rank >= errors.size()) { return 0.0; }
  std::vector<float> sums;
  sums.reserve(errors.size());
  for (const LinkError& e : errors) { sums.push_back(e.sum()); }
  std::nth_element(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(rank), sums.end(), std::greater<>{});
  return sums[rank];
}

}  // namespace detail

HALFLIGHT_INLINE std::size_t Deadline::links_left(std::uint64_t links) const {
  if (!seconds_) { return std::numeric_limits<std::size_t>::max(); }
  constexpr double for_solution = 0.2;
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double left = (1.0 - for_solution) * *seconds_ - spent;
  return left > 0.0 ? static_cast<std::size_t>(left / spent * static_cast<double>(links)) : 0;
}

HALFLIGHT_INLINE BfResult bf_refine(const Scene& scene, const raycast::Scene& objects, const Plan& plan,
                                    const std::vector<Color>& reflectance, const std::vector<Color>& emission,
                                    std::vector<Surface>& surfaces, Hierarchy& hierarchy, Patches& patches, Exposure& exposure,
                                    ShownAreas& shown, const LinkEvaluator& evaluator, double target, double leaf_part,
                                    const Deadline& deadline, std::size_t most_links, unsigned threads, std::uint64_t seed,
                                    const Control& control, const MemoryBudget& budget) {
  constexpr double first_epsilon = 0.25;
  BfResult result;
  const PairOracle oracle{surfaces, hierarchy};
  const bool clustered = !hierarchy.empty() && hierarchy[0].is_cluster();
  result.refined = refine(scene, objects, plan, surfaces, hierarchy, patches, first_epsilon, 1e-3, 0.0, threads, seed, control, budget);
  if (result.refined.cancelled || result.refined.too_many || result.refined.too_large) { return result; }
  double scene_area = 0.0;
  for (const Node& node : hierarchy) { scene_area += node.parent == no_node ? node.area : 0.0; }
  const double min_area = 0x1p-24 * scene_area;
  std::vector<bool> sees_itself;
  sees_itself.resize(hierarchy.size(), false);
  for (const std::uint32_t i : result.refined.inner) { sees_itself[i] = true; }
  std::vector<bool> stuck;

  Links& links = result.refined.links;
  std::vector<std::uint32_t>& lists = result.refined.lists;
  std::vector<LinkShape> shapes;
  DoubtSum removed;  // of links that carry nothing
  std::size_t evaluated = 0;
  const auto finished = [&] {  // without the links that were kept for what they might carry
    std::size_t kept = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (!(links[i].exchange > 0.0f)) { continue; }
      lists[kept] = lists[i];
      links[kept++] = links[i];
    }
    result.evaluated.blocked += links.size() - kept;
    links.resize(kept);
    lists.resize(kept);
    return std::move(result);
  };
  for (;;) {
    patches.extend(threads);
    extend(exposure, objects, surfaces, hierarchy, patches, threads, seed);
    if (clustered) {
      ShownAreas now{hierarchy, [&](std::size_t i) { return exposure.area[i]; }};
      for (std::size_t i = 0; i < evaluated; ++i) {
        if (!evaluator.between_patches(links[i])) { refit_cluster_link(hierarchy, links[i], shown, now); }
      }
      shown = std::move(now);
    }
    const std::size_t new_links = links.size() - evaluated;
    // Once there is a solution, a generation is brought to its end: half evaluated it would be none.
    const EvaluateResult round = evaluate(evaluator, result.refined.occluders, links, lists, evaluated, &shapes, threads,
                                          result.generations == 0 ? control : control.unstoppable());
    result.evaluations += new_links;
    result.evaluated.rays += round.rays;
    result.evaluated.proven_clear += round.proven_clear;
    result.evaluated.blocked += round.blocked;
    removed.add(round.doubt);
    result.evaluated.doubt = removed;
    for (std::size_t i = 0; i < links.size(); ++i) { result.evaluated.doubt.add(links[i].p, links[i].q, shapes[i].doubt); }
    result.evaluated.cancelled = round.cancelled;
    if (round.cancelled) { return result; }

    LinkSchedule::arrange(hierarchy.size(), links, lists, shapes);
    Transport transport{hierarchy, links, exposure, threads};
    if (plan.closed) { (void)transport.close(10.0, 1e-3); }
    const ColorSolution light =
        solve_channels(hierarchy, transport, exposure.area, reflectance, emission, plan.channels, Solver::conjugate_gradients, 1e-3, 40);
    detail::LeafErrors leaves = detail::estimate_leaf_errors(hierarchy, patches, exposure, links, reflectance, light.radiosity);
    detail::ErrorEstimation errors = detail::estimate_link_errors(std::nullopt, leaves.alike(), hierarchy, exposure, links, shapes,
                                                                  reflectance, emission, light.radiosity);
    errors.of_leaves = leaves.sum;
    for (float& e : leaves.squares) { e *= static_cast<float>(leaf_part * leaf_part); }
    const double sum = errors.sum(leaf_part);
    result.estimate = errors.relative(leaf_part);
    result.leaf_estimate = errors.relative(1.0);
    result.unseen = sum > 0.0 ? errors.unseen / sum : 0.0;
    if (budget.solved != nullptr) { *budget.solved = result.generations + 1; }
    // Where nothing is lit yet, light may still be found.
    const bool dark = !(errors.norm > 0.0) && sum > 0.0 && result.generations < 4;
    if ((!deadline.limited() && result.estimate <= target && !dark) || links.size() > most_links) { return finished(); }
    if (control.cancelled() || result.generations == budget.last_generation) {
      result.interrupted = control.cancelled();
      return finished();
    }
    const double allowed = deadline.limited() ? 0.0 : target * target * errors.norm;
    double least = detail::error_of_rank(errors.links, (most_links - links.size()) / 8);  // children of a cluster
    if (deadline.limited()) {
      const std::size_t most = deadline.links_left(result.evaluations) / 4;  // a link that is refined becomes four
      if (50 * most < links.size()) { return finished(); }
      least = std::max(least, detail::error_of_rank(errors.links, most));
    }

    // Which end of which link is to be split.
    enum class Split : std::uint8_t { none, p, q };
    std::vector<Split> splits;
    std::vector<bool> asked;
    const auto can_split = [&](std::uint32_t i) {
      return !hierarchy[i].leaf() || (hierarchy[i].area > min_area && !(i < stuck.size() && stuck[i]));
    };
    // The largest errors first; where none of them can be split any more, those after them.
    std::vector<float> of_links, of_leaves;
    for (double squeeze = 1.0;; squeeze *= 2.0) {  // fewer splits, those with the largest errors, until memory suffices
      of_links.clear();
      for (const detail::LinkError& e : errors.links) { of_links.push_back(e.sum()); }
      of_leaves = leaves.squares;
      splits.assign(links.size(), Split::none);
      asked.assign(hierarchy.size(), false);
      std::size_t chosen = 0;
      bool any = false;
      for (double left = sum; !any;) {
        if (!(left > allowed)) { return finished(); }
        const double keep = left - std::min(0.8 * left, 1.1 * (left - allowed));
        const double threshold = squeeze * std::max(least, detail::refinement_threshold(of_links, of_leaves, keep));
        double stays = 0.0;
        for (std::size_t i = 0; i < links.size(); ++i) {
          if (!(of_links[i] >= threshold && of_links[i] > 0.0f)) { continue; }
          const detail::LinkError& e = errors.links[i];
          const bool p_first = e.p >= e.q;
          const std::uint32_t first = p_first ? links[i].p : links[i].q;
          const std::uint32_t second = p_first ? links[i].q : links[i].p;
          if (can_split(first)) {
            splits[i] = p_first ? Split::p : Split::q;
            any = asked[first] = true;
          } else if (can_split(second) && (hierarchy[second].is_cluster() || std::min(e.p, e.q) >= 0.25f * e.sum())) {
            splits[i] = p_first ? Split::q : Split::p;
            any = asked[second] = true;
          } else {
            stays += of_links[i];
            of_links[i] = 0.0f;
          }
          chosen += splits[i] != Split::none ? 1 : 0;
        }
        for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {  // leaves whose constant is too coarse, while the links above will do
          if (!(of_leaves[i] >= threshold && of_leaves[i] > 0.0f)) { continue; }
          if (can_split(i)) {
            any = asked[i] = true;
            ++chosen;
          } else {
            stays += of_leaves[i];
            of_leaves[i] = 0.0f;
          }
        }
        if (!any && !(stays > 0.0)) { return finished(); }
        left -= stays;
      }
      if (squeeze > 1.0 && 50 * chosen < links.size()) { return finished(); }
      if (!budget.limited()) { break; }
      const auto parts = [&](std::uint32_t i) { return hierarchy[i].leaf() ? hierarchy[i].corners : hierarchy[i].child_count; };
      const auto split_links =
          static_cast<std::size_t>(std::count_if(splits.begin(), splits.end(), [](Split of) { return of != Split::none; }));
      MemoryBudget::Counts counts{hierarchy.size(), links.size() - split_links, 0, result.refined.occluders.bytes()};
      for (std::uint32_t i = 0; i < hierarchy.size(); ++i) { counts.nodes += asked[i] && hierarchy[i].leaf() ? parts(i) : 0; }
      for (std::size_t i = 0; i < links.size(); ++i) {
        counts.pairs += splits[i] == Split::none ? 0 : parts(splits[i] == Split::p ? links[i].p : links[i].q);
      }
      counts.links += counts.pairs;
      if (budget.allows(counts)) { break; }
      if (result.too_large == 0) { result.too_large = budget.peak(counts); }
    }

    const auto before = static_cast<std::uint32_t>(hierarchy.size());
    std::vector<detail::Pair> pairs;
    std::vector<float> blocked;  // of each pair, as in LinkShape
    stuck.resize(before, false);
    for (std::uint32_t i = 0; i < before; ++i) {
      if (!asked[i] || !hierarchy[i].leaf()) { continue; }
      if (!subdivide(surfaces, hierarchy, i)) {
        stuck[i] = true;
        continue;
      }
      sees_itself.resize(hierarchy.size(), sees_itself[i]);
      if (!sees_itself[i]) { continue; }
      const std::uint32_t first = hierarchy[i].first_child, last = first + hierarchy[i].child_count;
      for (std::uint32_t a = first; a < last; ++a) {
        for (std::uint32_t b = a + 1; b < last; ++b) { pairs.push_back({a, b}); }
      }
    }
    blocked.resize(pairs.size(), 0.0f);
    // Links that carry nothing, and would not matter if they did.
    const auto carry = std::count_if(errors.links.begin(), errors.links.end(), [](const detail::LinkError& e) { return e.sum() > 0.0f; });
    const double moot = 0.01 * allowed / static_cast<double>(carry);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (splits[i] == Split::none && !(links[i].exchange > 0.0f) && errors.links[i].sum() <= moot) {
        removed.add(links[i].p, links[i].q, shapes[i].doubt);
        ++result.evaluated.blocked;
        continue;
      }
      const std::uint32_t split = splits[i] == Split::p ? links[i].p : links[i].q;
      const std::uint32_t other = splits[i] == Split::p ? links[i].q : links[i].p;
      if (splits[i] == Split::none || hierarchy[split].leaf()) {
        shapes[kept] = shapes[i];
        lists[kept] = lists[i];
        links[kept++] = links[i];
        continue;
      }
      const float segments = links[i].exchange > 0.0f ? 0.0f : shapes[i].blocked + segments_per_round;
      for (std::uint32_t k = 0; k < hierarchy[split].child_count; ++k) {
        pairs.push_back({hierarchy[split].first_child + k, other, lists[i]});
        blocked.push_back(segments * static_cast<float>(hierarchy[split].child_count));
      }
    }
    links.resize(kept);
    lists.resize(kept);
    shapes.resize(kept);
    evaluated = kept;
    patches.extend(threads);
    while (!pairs.empty()) {
      const std::vector<Decision> decisions = detail::decide(
          pairs, objects, plan, patches, result.refined, threads,
          [&](std::uint32_t p, std::uint32_t q) {
            const Node& a = hierarchy[p];
            const Node& b = hierarchy[q];
            if (oracle.convex(a, b)) { return Decision::convex; }
            return a.is_cluster() || b.is_cluster() ? Decision::link : f_oracle(a, b, 1.0, min_area);
          },
          [](std::size_t, const raycast::OccluderList&, Decision&) {});
      std::vector<detail::Pair> parts;  // of faces that come out of their clusters in too many to be linked
      std::vector<float> blocked_parts;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (decisions[i] < first_seeing) { continue; }
        const auto [p, q, list] = pairs[i];
        const std::uint32_t split = decisions[i] == Decision::split_p ? p : q;
        if (decisions[i] == Decision::link || !hierarchy[split].in_parts()) {
          links.push_back({p, q});
          lists.push_back(list);
          shapes.emplace_back().blocked = blocked[i];
          continue;
        }
        for (std::uint32_t k = 0; k < hierarchy[split].child_count; ++k) {
          parts.push_back({hierarchy[split].first_child + k, split == p ? q : p, list});
          blocked_parts.push_back(blocked[i]);
        }
      }
      pairs = std::move(parts);
      blocked = std::move(blocked_parts);
    }
    ++result.generations;
    if (control.after_generation) { control.after_generation(surfaces); }
    control.report("refine", std::min(1.0, target / result.estimate));
  }
}

}  // namespace radiosity
