// SPDX-License-Identifier: MIT

// Stage: computes form factors and visibility of the links of F-refinement (paper 4.3), and makes links of stored rays.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/links/evaluate.hpp>
#include <radiosity/rays/ray_links.hpp>
#include <radiosity/rays/spacing.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/leaf_splits.hpp>
#include <radiosity/refinement/link_splits.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/f_refinement.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/leaf_locator.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

[[nodiscard]] HALFLIGHT_INLINE std::optional<Failure> link_by_rays(Run& run) {
  DiscreteScene& scene = run.scene;
  const Audit& audit = run.solution.audit;
  const SpacingResult spacing = space_casters(scene, run.solution.links, run.importance, audit.epsilon, audit.min_area * lit_part(run));
  run.rays_of_spacing += spacing.rays;
  run.solution.audit.rays_for_view = scene.control.viewpoint.has_value();
  if (spacing.cancelled) { return cancelled(); }
  if (spacing.too_large > 0) {
    return Failure{Failure::Kind::out_of_memory,
                   {too_much_memory(spacing.too_large, scene.budget, "a larger epsilon or min_area needs less")}};
  }
  // If little of the scene is lit few rays meet light, so the noise would be larger: cast more.
  const double more = std::min(4.0, 1.0 / std::sqrt(lit_part(run)));
  const std::vector<std::uint32_t> counts = ray_counts(scene, spacing.casters, more * rays_per_node(audit.epsilon));
  const std::uint64_t rays = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (rays > ray_limit) {
    return Failure{Failure::Kind::invalid_options,
                   {"the run would need " + std::to_string(rays / 1'000'000) + " million rays; the limit is " +
                    std::to_string(ray_limit / 1'000'000) + " million; a larger epsilon needs fewer"}};
  }
  const MemoryBudget::Counts needed{scene.hierarchy.size(), run.solution.links.size(), 0, 0, rays};
  if (!scene.budget.allows(needed)) {
    return Failure{Failure::Kind::out_of_memory,
                   {too_much_memory(scene.budget.peak(needed), scene.budget,
                                    run.options.error ? "a larger error needs less" : "a larger epsilon needs less")}};
  }
  const StoredRays stored = cast_rays(scene, LeafLocator{scene.hierarchy, scene.patches, scene.inputs.size()}, counts);
  if (scene.control.cancelled()) { return cancelled(); }
  run.ray_links = make_ray_links(scene, stored, spacing.casters);
  return std::nullopt;
}

// May links be split once they are evaluated? Not if other light goes by stored rays, because then only links of lamps exist, for which
// the light oracle has already split; and not with leaves that were cut along shadow edges, which stay as they are. If memory does not
// suffice, run.refined.too_large is set.
[[nodiscard]] HALFLIGHT_INLINE bool may_split_links(Run& run, std::uint64_t links) {
  const DiscreteScene& scene = run.scene;
  if (run.rays.cast || scene.light_meshing || run.stopped()) { return false; }
  const MemoryBudget::Counts needed{scene.hierarchy.size(), links, 0, run.refined.occluders.bytes() + links * sizeof(LinkDoubt)};
  if (!scene.budget.allows(needed)) { run.refined.too_large = scene.budget.peak(needed); }
  return run.refined.too_large == 0;
}

inline constexpr std::uint32_t most_rounds_again = 16 * patch_rounds;  // for links that are evaluated again, as the error estimate does

// Rounds of segments for each partly blocked link. Where what the camera sees is lit through small openings, one segment in ten thousand
// from a lamp may arrive, as from a sun through a hole of some centimetres, and of 16 none tells nothing: up to 65 536 are cast before a
// link counts as dark, as many as make four million in all.
[[nodiscard]] HALFLIGHT_INLINE std::uint32_t visibility_rounds(const Run& run, std::size_t links) {
  constexpr std::size_t most_decide = 4096, most_segments = std::size_t{1} << 22;
  if (!lit_through_openings(run.importance)) { return patch_rounds; }
  const std::size_t decide = most_segments / (segments_per_round * std::max<std::size_t>(links, 1));
  return patch_rounds * static_cast<std::uint32_t>(std::clamp(decide, std::size_t{1}, most_decide));
}

// Evaluates the links chosen by refinement.
HALFLIGHT_INLINE void link_by_forms(Run& run) {
  DiscreteScene& scene = run.scene;
  if (run.solution.audit.clusters > 0) { scene.shown = scene.exposed_shown(); }
  if (run.solution.audit.clusters > 0 && !scene.clustered()) {
    std::vector<double> emission;
    for (const Color& e : scene.emission) { emission.push_back(brightest(e)); }
    scene.lamp_exchange.emplace(scene.view(), &scene.exposure, scene.shown, emission);
    scene.evaluator.use(*scene.lamp_exchange);
  }
  const NodePairs pairs = std::exchange(run.refined.linked, {});
  const bool split = may_split_links(run, pairs.size());
  const std::uint32_t rounds = visibility_rounds(run, pairs.size());
  scene.evaluator.cast_rounds(rounds);
  run.evaluated = make_links({scene.evaluator, run.refined.occluders, scene.threads, scene.control}, pairs, run.solution.links,
                             split ? &run.doubts : nullptr);
  scene.evaluator.cast_rounds(std::min(rounds, most_rounds_again));
}

// Splits links whose light varies over their ends in a way that they cannot express.
HALFLIGHT_INLINE void split_links(Run& run) {
  LinkDoubts doubts = std::exchange(run.doubts, {});
  if (doubts.size() != run.solution.links.size() || run.stopped()) { return; }
  const Audit& audit = run.solution.audit;
  run.link_splits = split_links_by_light(run.scene, {run.refined, run.solution.links, doubts, run.evaluated},
                                         {audit.epsilon, audit.light_epsilon, audit.min_area});
  // If some of the splits did not fit, the result would differ from that of a run with these thresholds and more memory; so
  // this counts as a shortage.
  run.refined.too_large = run.link_splits.too_large;
}

// Splits leaves by their light. Leaves cut along shadow edges stay as they are.
HALFLIGHT_INLINE void split_leaves_once_more(Run& run) {
  DiscreteScene& scene = run.scene;
  const Audit& audit = run.solution.audit;
  if (scene.light_meshing || audit.interrupted) { return; }
  run.leaf_splits =
      split_leaves_by_light(scene, run.solution.links, {audit.light_epsilon, audit.min_area * lit_part(run)}, run.evaluated.doubt);
  if (run.leaf_splits.count > 0 && scene.control.after_generation) { scene.control.after_generation(scene.surfaces); }
}

}  // namespace detail

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> link(detail::Run& run) {
  DiscreteScene& scene = run.scene;
  if (run.f_refined()) {
    detail::link_by_forms(run);
    if (run.evaluated.cancelled) {
      detail::refine_coarsely(run);
      scene.expose();
      detail::link_by_forms(run);
    }
    if (!run.refined.too_large) { detail::split_links(run); }
    if (std::optional<Failure> failure = detail::refusal(run)) { return failure; }
    detail::split_leaves_once_more(run);
    run.solution.audit.interrupted = run.stopped();
    std::optional<Failure> failure = run.rays.cast ? detail::link_by_rays(run) : std::nullopt;
    if (failure && failure->kind == Failure::Kind::cancelled) {
      detail::hurry(run);
      failure = detail::link_by_rays(run);
    }
    if (failure) { return failure; }
  }
  run.watch.lap("link");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
