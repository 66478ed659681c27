// SPDX-License-Identifier: MIT
#include <radiosity/links/evaluate.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/inline.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/clusters/cluster_exchange.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/exchange/doubt.hpp>
#include <radiosity/exchange/exchange.hpp>
#include <radiosity/geometry/directions.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// What the exposed part of a patch exchanges with `other`, over what the whole patch would: its share of the area, unless the
// other's horizon cuts the patch. Then the object that buries the rest is often the one that draws the horizon (the wall of a
// post and the floor around it), and the share is that of the part above the horizon.
[[nodiscard]] HALFLIGHT_INLINE double exposed_share(const PatchEnd& end, double exposed_area, const Patch& other) {
  const Patch& patch = *end.patch;
  if (end.exposed == nullptr || above_horizon(other, patch) != 0) { return exposed_area / patch.area; }
  return end.exposed->share_above(patch, other.centre, other.normal);
}

// Pairs of points, in rounds of 16, for each link of a cluster: a mean over many faces that hide each other, so never few.
inline constexpr std::uint32_t cluster_rounds = 4;

HALFLIGHT_INLINE LinkEvaluator::LinkEvaluator(const raycast::Scene& scene, const Plan& plan, const Hierarchy& hierarchy,
                                              const Patches& patches, const Exposure& exposure, const ShownAreas& shown, std::uint64_t seed)
    : scene_{&scene},
      plan_{&plan},
      hierarchy_{&hierarchy},
      patches_{&patches},
      exposure_{&exposure},
      sampler_{scene, hierarchy, patches, &exposure, shown},
      seed_{seed} {}

HALFLIGHT_INLINE RayCount LinkEvaluator::operator()(Link& link, const raycast::OccluderList& list, LinkShape* shape, Doubt* doubt) const {
  const Patch& p = (*patches_)[link.p];
  const Patch& q = (*patches_)[link.q];
  const double area_p = exposure_->area[link.p];
  const double area_q = exposure_->area[link.q];
  link.exchange = 0.0f;
  if (!(area_p > 0.0) || !(area_q > 0.0)) { return {}; }
  if (!between_patches(link)) {
    const Random random{seed_, (std::uint64_t{link.p} << 32) | link.q};
    const ClusterExchange seen = evaluate_cluster_link(sampler_, *hierarchy_, link, cluster_rounds, random);
    const LinkShape of_link = shape_of_cluster_link(link, seen, shape != nullptr ? *shape : LinkShape{});
    if (shape != nullptr) { *shape = of_link; }
    if (doubt != nullptr) { doubt->square = static_cast<float>(doubt_of_cluster_link(link, of_link)); }
    return {seen.rays, 0};
  }
  const double unoccluded = exchange(p, q);
  if (!(unoccluded > 0.0)) {
    // The patches face away from each other; where they are curved, parts of their surfaces may not.
    const double light = shape != nullptr && (p.bent || q.bent) ? variations(p, q).light : 0.0;
    if (!(light > 0.0)) { return {}; }
    const VisibilityEstimate seen = visibility(*scene_, *plan_, list, end(link.p), end(link.q), 1, Random{seed_, key_of(link)});
    shape->sampling = static_cast<float>(seen.fraction > 0.0 ? light : missed(light, *shape, seen.rays.cast));
    return seen.rays;
  }
  const Node& node_p = (*hierarchy_)[link.p];
  const Node& node_q = (*hierarchy_)[link.q];
  const std::uint64_t key = key_of(link);
  const PatchEnd end_p = end(link.p);
  const PatchEnd end_q = end(link.q);
  const VisibilityEstimate seen = visibility(*scene_, *plan_, list, end_p, end_q, patch_rounds, Random{seed_, key});
  // On curved objects the area of the finer leaves counts too: the patch passes it on with its own kernel.
  const double share = exposed_share(end_p, area_p, q) * exposed_share(end_q, area_q, p);
  link.exchange = static_cast<float>(unoccluded * seen.fraction * share);
  Variations light_varies;
  if (shape != nullptr || !node_p.leaf() || !node_q.leaf()) {
    light_varies = variations(p, q);
    link.slope_p = glm::vec3{light_varies.p.slope};
    link.slope_q = glm::vec3{light_varies.q.slope};
    if (shape != nullptr && seen.fraction > 0.0) {
      *shape = {shape_of(light_varies.p, seen.spread_p / seen.fraction),
                shape_of(light_varies.q, seen.spread_q / seen.fraction),
                static_cast<float>(light_varies.cross),
                static_cast<float>(partly_seen(unoccluded * share, seen)),
                0.0f,
                {}};
    }
  }
  if (shape != nullptr && !(seen.fraction > 0.0)) {
    shape->sampling = static_cast<float>(missed(unoccluded * share, *shape, seen.rays.cast));
  }
  if (doubt != nullptr) { *doubt = doubt_of(link, unoccluded * share, seen, light_varies); }
  return seen.rays;
}

HALFLIGHT_INLINE Doubt LinkEvaluator::doubt_of(const Link& link, double sent, const VisibilityEstimate& seen,
                                               const Variations& varies) const {
  const auto square = [](double x) { return x * x; };
  const Node& p = (*hierarchy_)[link.p];
  const Node& q = (*hierarchy_)[link.q];
  const double area_p = exposure_->area[link.p];
  const double area_q = exposure_->area[link.q];
  const double arrives = sent * seen.fraction;
  const auto across = [&](const Node& node, const Variation& v, double spread, double area) {
    return node.leaf() ? 0.0f : static_cast<float>(std::sqrt(square(arrives * v.rest) + square(sent * spread)) / area);
  };
  const double unseen = seen.proven ? 0.0 : square(sent) * visibility_variance(seen.fraction, static_cast<double>(seen.rays.cast));
  const auto buried = [&](std::uint32_t i, double area) {  // variance of the exposed area, relative
    return exposure_->partly_buried[i] ? std::max(0.0, (exposure_->whole[i] - area) / (256.0 * area)) : 0.0;
  };
  const double depth = 0.5 * (square(p.deviation) + square(q.deviation));
  const double independent =
      (unseen + square(arrives) * buried(link.q, area_q)) / area_p + (unseen + square(arrives) * buried(link.p, area_p)) / area_q;
  return {across(p, varies.p, seen.spread_p, area_p), across(q, varies.q, seen.spread_q, area_q), static_cast<float>(independent),
          static_cast<float>(2.0 * arrives * depth), static_cast<float>(depth)};
}

HALFLIGHT_INLINE LinkShape LinkEvaluator::shape_of_cluster_link(const Link& link, const ClusterExchange& seen,
                                                                const LinkShape& before) const {
  const auto square = [](double x) { return x * x; };
  const Node& p = (*hierarchy_)[link.p];
  const Node& q = (*hierarchy_)[link.q];
  const glm::dvec3 d = q.centre - p.centre;
  const double r = glm::length(d);
  if (!(r > 0.0)) { return {}; }
  if (!(seen.exchange > 0.0)) {
    const double most = sampler_.end(link.p, d).shown * sampler_.end(link.q, -d).shown / (std::numbers::pi * r * r);
    return {{}, {}, 0.0f, static_cast<float>(missed(most, before, segments_per_round)), before.blocked, {}};
  }
  const double hidden = (1.0 - seen.fraction) / seen.fraction;
  const auto end = [&](const Node& node) {
    const double near = square(2.0 * node.radius / r) / 12.0;
    const double rest = node.is_cluster() ? 8.0 / 3.0 * near + 0.02 : near;
    return LinkShape::End{0.0f, static_cast<float>(std::sqrt(rest)), static_cast<float>(std::sqrt(hidden * std::min(1.0, 20.0 * near)))};
  };
  const double error = seen.exchange * seen.spread / std::sqrt(std::max(16.0, static_cast<double>(seen.rays)));
  return {end(p), end(q), 0.0f, static_cast<float>(error), 0.0f, {}};
}

HALFLIGHT_INLINE double LinkEvaluator::doubt_of_cluster_link(const Link& link, const LinkShape& shape) const {
  const double exchange = static_cast<double>(link.exchange);
  const double sampling = static_cast<double>(shape.sampling);
  const auto end = [&](std::uint32_t i, const LinkShape::End& e) {
    const double across = static_cast<double>(e.rest * e.rest + e.shadow * e.shadow);
    return (exchange * exchange * across + sampling * sampling) / exposure_->area[i];
  };
  return exchange > 0.0 ? end(link.p, shape.p) + end(link.q, shape.q) : 0.0;
}

HALFLIGHT_INLINE void refit_cluster_link(const Hierarchy& hierarchy, Link& link, const ShownAreas& before, const ShownAreas& now) {
  const glm::dvec3 d = glm::normalize(hierarchy[link.q].centre - hierarchy[link.p].centre);
  const auto end = [&](std::uint32_t i, const glm::dvec3& to, Slope& slope) {
    if (!hierarchy[i].is_cluster()) { return; }
    const glm::dvec3 towards = Slope{glm::vec3{to}}.vector();
    const double shown_before = before.of(hierarchy[i], aim(towards));
    const double shown_now = now.of(hierarchy[i], aim(towards));
    if (shown_before == shown_now) { return; }
    const bool shows = shown_before > 0.0 && shown_now > 0.0;
    link.exchange = shows ? static_cast<float>(link.exchange * (shown_now / shown_before)) : 0.0f;
    slope = shows ? Slope{glm::vec3{towards / shown_now}} : Slope{};
  };
  end(link.p, d, link.slope_p);
  end(link.q, -d, link.slope_q);
}

HALFLIGHT_INLINE EvaluateResult evaluate(const LinkEvaluator& evaluator, const OccluderLists& occluders, Links& links,
                                         std::vector<std::uint32_t>& lists, std::size_t first, std::vector<LinkShape>* shapes,
                                         unsigned threads, const Control& control) {
  EvaluateResult result;
  const std::size_t count = links.size() - first;
  const auto stays = [&](std::size_t i) {
    return links[i].exchange > 0.0f || (shapes != nullptr && (*shapes)[i].sampling > 0.0f && lists[i] != OccluderLists::hidden);
  };
  if (shapes != nullptr) { shapes->resize(links.size()); }
  std::vector<RayCount> rays(count);
  std::vector<Doubt> doubts;
  constexpr std::size_t batch = 1 << 16;  // between two looks at the cancel flag
  for (std::size_t done = 0; done < count; done += batch) {
    if (control.cancelled()) {
      result.cancelled = true;
      return result;
    }
    doubts.assign(std::min(batch, count - done), {});
    parallel_for(doubts.size(), threads, [&](std::size_t offset) {
      if (control.cancelled()) { return; }
      const std::size_t i = first + done + offset;
      rays[done + offset] = evaluator(links[i], occluders[lists[i]], shapes != nullptr ? &(*shapes)[i] : nullptr, &doubts[offset]);
    });
    for (std::size_t offset = 0; offset < doubts.size(); ++offset) {
      const std::size_t i = first + done + offset;
      if (shapes != nullptr && stays(i)) {
        (*shapes)[i].doubt = doubts[offset];
      } else if (lists[i] != OccluderLists::hidden) {  // of a pair that was proven to exchange nothing there is none
        result.doubt.add(links[i].p, links[i].q, doubts[offset]);
      }
    }
    if (shapes == nullptr) { control.report("link", static_cast<double>(std::min(done + batch, count)) / static_cast<double>(count)); }
  }

  if (control.cancelled()) {
    result.cancelled = true;
    return result;
  }
  std::size_t kept = first;
  for (std::size_t i = first; i < links.size(); ++i) {
    result.rays += rays[i - first];
    if (stays(i)) {
      result.proven_clear += rays[i - first].avoided > 0 ? 1 : 0;
      if (shapes != nullptr) { (*shapes)[kept] = (*shapes)[i]; }
      lists[kept] = lists[i];
      links[kept++] = links[i];
    } else {
      ++result.blocked;
    }
  }
  links.resize(kept);
  lists.resize(kept);
  if (shapes != nullptr) { shapes->resize(kept); }
  return result;
}

}  // namespace radiosity
