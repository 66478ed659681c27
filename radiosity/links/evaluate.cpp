// SPDX-License-Identifier: MIT
#include <radiosity/links/evaluate.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/shaft.hpp>

#include <radiosity/clusters/cluster_exchange.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/discontinuity/light_meshing.hpp>
#include <radiosity/exchange/doubt.hpp>
#include <radiosity/exchange/exchange.hpp>
#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// The share of the patch's exchange with `other` that its exposed part has: its share of the area, unless the other's horizon cuts the
// patch. In that case the object that buries the rest often also defines the horizon (the wall of a post and the floor around it), and
// the share is that of the part above the horizon.
[[nodiscard]] HALFLIGHT_INLINE double exposed_share(const PatchEnd& end, double exposed_area, const Patch& other) {
  const Patch& patch = *end.patch;
  if (end.exposed == nullptr || above_horizon(other, patch) != 0) { return exposed_area / patch.area; }
  return end.exposed->share_above(patch, other.centre, other.normal);
}

// Rounds of 16 pairs of points for each cluster link. Never fewer, because it is a mean over many faces that hide each other.
inline constexpr std::uint32_t cluster_rounds = 4;

// Relative change of the light between two patches by replacing curves by chords.
[[nodiscard]] HALFLIGHT_INLINE double chord_depth(const Node& p, const Node& q) {
  return 0.5 * (p.deviation * p.deviation + q.deviation * q.deviation);
}

HALFLIGHT_INLINE Doubt LinkDoubt::of(const Link& link, const Hierarchy& hierarchy) const {
  const double depth = chord_depth(hierarchy[link.p], hierarchy[link.q]);
  return {p, q, square, static_cast<float>(2.0 * static_cast<double>(link.exchange) * depth), static_cast<float>(depth)};
}

HALFLIGHT_INLINE void EvaluateResult::add(const EvaluateResult& other) {
  rays += other.rays;
  proven_clear += other.proven_clear;
  blocked += other.blocked;
  unseen.add(other.unseen);
  doubt.add(other.doubt);
  cancelled = cancelled || other.cancelled;
}

HALFLIGHT_INLINE LinkEvaluator::LinkEvaluator(const SceneView& scene, const Exposure& exposure, const ShownAreas& shown, std::uint64_t seed)
    : scene_{scene}, exposure_{&exposure}, sampler_{scene, &exposure, shown}, seed_{seed} {}

HALFLIGHT_INLINE void set_gradients(Link& link, const Variations& light) {
  link.shape_p = EndShape::of_patch(glm::vec3{light.p.slope});
  link.shape_q = EndShape::of_patch(glm::vec3{light.q.slope});
}

HALFLIGHT_INLINE RayCount LinkEvaluator::operator()(Link& link, const raycast::OccluderList& list, LinkVariation* variation,
                                                    Doubt* doubt) const {
  const Patch& p = scene_.patches[link.p];
  const Patch& q = scene_.patches[link.q];
  const double area_p = exposure_->area[link.p];
  const double area_q = exposure_->area[link.q];
  link.exchange = 0.0f;
  if (!(area_p > 0.0) || !(area_q > 0.0)) { return {}; }
  const bool both = scene_.hierarchy[link.p].is_cluster() && scene_.hierarchy[link.q].is_cluster();
  if (lamps_ != nullptr && !between_patches(link) && !both) { return evaluate_lamp_link(link, variation, doubt); }
  if (!between_patches(link)) {
    const Random random{seed_, (std::uint64_t{link.p} << 32) | link.q};
    const ClusterExchange seen = evaluate_cluster_link(sampler_, scene_.hierarchy, link, cluster_rounds, random);
    const LinkVariation of_link = variation_of_cluster_link(link, seen, variation != nullptr ? *variation : LinkVariation{});
    if (variation != nullptr) { *variation = of_link; }
    if (doubt != nullptr) { doubt->square = static_cast<float>(doubt_of_cluster_link(link, of_link)); }
    return {seen.rays, 0};
  }
  const Node& node_p = scene_.hierarchy[link.p];
  const Node& node_q = scene_.hierarchy[link.q];
  const bool varying = variation != nullptr || !node_p.leaf() || !node_q.leaf();
  const Variations light_varies = varying ? variations(p, q) : Variations{};
  const double unoccluded = exchange(p, q, varying ? &light_varies : nullptr);
  if (!(unoccluded > 0.0)) {
    // The patches face away from each other, but if they are curved, parts of their surfaces may face each other.
    const double light = variation != nullptr && (p.bent || q.bent) ? light_varies.light : 0.0;
    if (!(light > 0.0)) { return {}; }
    const VisibilityEstimate seen = visibility(scene_, list, ends(link), 1, Random{seed_, key_of(link)});
    variation->sampling = static_cast<float>(seen.fraction > 0.0 ? light : missed(light, *variation, seen.rays.cast));
    return seen.rays;
  }
  const std::uint64_t key = key_of(link);
  const PatchPair pair = ends(link);
  const std::optional<VisibilityEstimate> measured = measured_visibility(link);
  const VisibilityEstimate seen = measured ? *measured : visibility(scene_, list, pair, rounds_, Random{seed_, key});
  // On curved objects the area of the finer leaves counts, too, because the patch passes light on to them with its own kernel.
  const double share = exposed_share(pair.p, area_p, q) * exposed_share(pair.q, area_q, p);
  link.exchange = static_cast<float>(unoccluded * seen.fraction * share);
  if (varying) {
    set_gradients(link, light_varies);
    if (variation != nullptr && seen.fraction > 0.0) {
      *variation = {variation_at(light_varies.p, seen.spread_p / seen.fraction),
                    variation_at(light_varies.q, seen.spread_q / seen.fraction),
                    static_cast<float>(light_varies.cross),
                    static_cast<float>(partly_seen(unoccluded * share, seen)),
                    0.0f,
                    {}};
    }
  }
  if (variation != nullptr && !(seen.fraction > 0.0)) {
    variation->sampling = static_cast<float>(missed(unoccluded * share, *variation, seen.rays.cast));
  }
  if (doubt != nullptr) { *doubt = doubt_of(link, unoccluded * share, seen, light_varies, variation == nullptr); }
  return seen.rays;
}

// The total projected area of the lamp and the gradients over the patch are accurate. The distribution of the returning light over the
// lamp's faces comes from the lattice of directions, whose errors are equal for all light from about one direction, so they add up.
HALFLIGHT_INLINE RayCount LinkEvaluator::evaluate_lamp_link(Link& link, LinkVariation* variation, Doubt* doubt) const {
  const LampExchange::Result seen = lamps_->evaluate(link, rounds_, Random{seed_, key_of(link)});
  const bool p_shines = scene_.hierarchy[link.p].is_cluster();
  VisibilityEstimate arrives;
  arrives.fraction = seen.fraction;
  arrives.rays = seen.rays;
  const ClusterExchange exchange{seen.sent * seen.fraction, seen.fraction, 0.0, seen.rays.cast};
  LinkVariation of_link = variation_of_cluster_link(link, exchange, variation != nullptr ? *variation : LinkVariation{});
  if (exchange.exchange > 0.0) {
    LinkVariation::End& end = p_shines ? of_link.q : of_link.p;
    end.linear = static_cast<float>(seen.linear);
    end.rest = static_cast<float>(seen.rest);
    of_link.sampling = static_cast<float>(partly_seen(seen.sent, arrives));
  } else if (seen.sent > 0.0) {
    of_link.sampling = static_cast<float>(missed(seen.sent, variation != nullptr ? *variation : LinkVariation{}, seen.rays.cast));
  } else {
    of_link = {};
  }
  if (variation != nullptr) { *variation = of_link; }
  if (doubt != nullptr && exchange.exchange > 0.0) {
    const auto across = [&](std::uint32_t i, const LinkVariation::End& e) {
      return static_cast<float>(exchange.exchange * std::hypot(e.rest, e.shadow) / exposure_->area[i]);
    };
    const double sampling = static_cast<double>(of_link.sampling) * static_cast<double>(of_link.sampling);
    doubt->p = across(link.p, of_link.p);
    doubt->q = across(link.q, of_link.q);
    doubt->square = static_cast<float>(sampling / exposure_->area[link.p] + sampling / exposure_->area[link.q]);
  }
  return seen.rays;
}

HALFLIGHT_INLINE std::optional<VisibilityEstimate> LinkEvaluator::measured_visibility(const Link& link) const {
  if (light_ == nullptr) { return std::nullopt; }
  for (const auto& [lamp, receiver] : {std::pair{link.p, link.q}, std::pair{link.q, link.p}}) {
    if (exposure_->partly_buried[lamp] || exposure_->partly_buried[receiver]) { continue; }
    const std::optional<double> share = light_->seen_share(scene_.hierarchy, lamp, receiver);
    if (!share) { continue; }
    VisibilityEstimate seen;
    seen.fraction = *share;
    seen.proven = true;
    return seen;
  }
  return std::nullopt;
}

HALFLIGHT_INLINE Doubt LinkEvaluator::doubt_of(const Link& link, double sent, const VisibilityEstimate& seen, const Variations& varies,
                                               bool at_leaves) const {
  const auto square = [](double x) { return x * x; };
  const Node& p = scene_.hierarchy[link.p];
  const Node& q = scene_.hierarchy[link.q];
  const double area_p = exposure_->area[link.p];
  const double area_q = exposure_->area[link.q];
  const double arrives = sent * seen.fraction;
  const auto across = [&](const Node& node, const Variation& v, double spread, double area) {
    if (node.leaf() && !at_leaves) { return 0.0f; }
    return static_cast<float>(std::sqrt(square(arrives * v.rest) + square(sent * spread)) / area);
  };
  const double unseen = seen.proven ? 0.0 : square(sent) * visibility_variance(seen.fraction, static_cast<double>(seen.rays.cast));
  const auto buried = [&](std::uint32_t i, double area) {  // relative variance of the exposed area
    return exposure_->partly_buried[i] ? std::max(0.0, (exposure_->whole[i] - area) / (256.0 * area)) : 0.0;
  };
  const double depth = chord_depth(p, q);
  const double independent =
      (unseen + square(arrives) * buried(link.q, area_q)) / area_p + (unseen + square(arrives) * buried(link.p, area_p)) / area_q;
  return {across(p, varies.p, seen.spread_p, area_p), across(q, varies.q, seen.spread_q, area_q), static_cast<float>(independent),
          static_cast<float>(2.0 * arrives * depth), static_cast<float>(depth)};
}

HALFLIGHT_INLINE LinkVariation LinkEvaluator::variation_of_cluster_link(const Link& link, const ClusterExchange& seen,
                                                                        const LinkVariation& before) const {
  const auto square = [](double x) { return x * x; };
  const Node& p = scene_.hierarchy[link.p];
  const Node& q = scene_.hierarchy[link.q];
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
    const double shadow = hidden * std::min(1.0, 20.0 * near);
    return LinkVariation::End{0.0f, static_cast<float>(std::sqrt(rest)), static_cast<float>(std::sqrt(shadow))};
  };
  const double error = seen.exchange * seen.spread / std::sqrt(std::max(16.0, static_cast<double>(seen.rays)));
  return {end(p), end(q), 0.0f, static_cast<float>(error), 0.0f, {}};
}

HALFLIGHT_INLINE double LinkEvaluator::doubt_of_cluster_link(const Link& link, const LinkVariation& variation) const {
  const double exchange = static_cast<double>(link.exchange);
  const double sampling = static_cast<double>(variation.sampling);
  const auto end = [&](std::uint32_t i, const LinkVariation::End& e) {
    const double across = static_cast<double>(e.rest * e.rest + e.shadow * e.shadow);
    return (exchange * exchange * across + sampling * sampling) / exposure_->area[i];
  };
  return exchange > 0.0 ? end(link.p, variation.p) + end(link.q, variation.q) : 0.0;
}

HALFLIGHT_INLINE void refit_cluster_link(const Hierarchy& hierarchy, Link& link, const ShownAreas& before, const ShownAreas& now) {
  const glm::dvec3 d = glm::normalize(hierarchy[link.q].centre - hierarchy[link.p].centre);
  const auto end = [&](std::uint32_t i, const glm::dvec3& to, EndShape& shape) {
    if (!hierarchy[i].is_cluster()) { return; }
    const glm::dvec3 towards = EndShape::stored_direction(to);
    const double shown_before = before.of(hierarchy[i], aim(towards));
    const double shown_now = now.of(hierarchy[i], aim(towards));
    if (shown_before == shown_now) { return; }
    const bool shows = shown_before > 0.0 && shown_now > 0.0;
    link.exchange = shows ? static_cast<float>(link.exchange * (shown_now / shown_before)) : 0.0f;
    shape = shows ? EndShape::of_cluster(towards, shown_now) : EndShape{};
  };
  end(link.p, d, link.shape_p);
  end(link.q, -d, link.shape_q);
}

// Evaluates `count` links in batches: evaluate(i, doubt) in parallel, then keep(i, doubt) in order, which returns whether the link is
// kept. Calls done(number kept so far) after each batch.
template <class Evaluate, class Keep, class Done>
void evaluate_in_order(const Evaluation& by, std::size_t count, EvaluateResult& result, const Evaluate& evaluate, const Keep& keep,
                       const Done& done) {
  std::vector<RayCount> rays;
  std::vector<Doubt> doubts;
  const bool complete = in_batches(by.control, count, 1 << 16, [&](std::size_t first, std::size_t last) {
    const std::size_t size = last - first;
    rays.assign(size, {});
    doubts.assign(size, {});
    parallel_for(size, by.threads, [&](std::size_t k) {
      if (!by.control.cancelled()) { rays[k] = evaluate(first + k, doubts[k]); }
    });
    result.cancelled = by.control.cancelled();
    if (result.cancelled) { return; }
    for (std::size_t k = 0; k < size; ++k) {
      result.rays += rays[k];
      if (keep(first + k, doubts[k])) {
        result.proven_clear += rays[k].avoided > 0 ? 1 : 0;
      } else {
        ++result.blocked;
      }
    }
    done(last);
  });
  result.cancelled = result.cancelled || !complete;
}

HALFLIGHT_INLINE EvaluateResult make_links(const Evaluation& by, const NodePairs& pairs, Links& links, LinkDoubts* doubts) {
  EvaluateResult result;
  links.clear();
  links.resize(pairs.size());  // each link at its index until its batch is complete
  if (doubts != nullptr) {
    doubts->clear();
    doubts->reserve(pairs.size());
  }
  std::size_t kept = 0;
  evaluate_in_order(
      by, pairs.size(), result,
      [&](std::size_t i, Doubt& doubt) {
        links[i].p = pairs[i].p;
        links[i].q = pairs[i].q;
        return by.evaluator(links[i], by.occluders[pairs[i].list], nullptr, &doubt);
      },
      [&](std::size_t i, const Doubt& doubt) {
        // A pair that is proven to exchange nothing has no error.
        const bool hidden = pairs[i].list == OccluderLists::hidden;
        if (!hidden) { result.doubt.add(pairs[i].p, pairs[i].q, doubt); }
        if (!(links[i].exchange > 0.0f)) {
          if (!hidden && doubt.square > 0.0f) { result.unseen.add(pairs[i].p, pairs[i].q); }
          return false;
        }
        if (doubts != nullptr) { doubts->push_back({pairs[i].list, doubt.p, doubt.q, doubt.square}); }
        links[kept++] = links[i];
        return true;
      },
      [&](std::size_t done) { by.control.report("link", static_cast<double>(done) / static_cast<double>(pairs.size())); });
  links.resize(kept);
  return result;
}

HALFLIGHT_INLINE EvaluateResult measure_links(const Evaluation& by, MeasuredLinks& links, std::size_t first) {
  EvaluateResult result;
  std::size_t kept = first;
  evaluate_in_order(
      by, links.size() - first, result,
      [&](std::size_t i, Doubt& doubt) {
        MeasuredLink& measured = links[first + i];
        return by.evaluator(measured.link, by.occluders[measured.list], &measured.variation, &doubt);
      },
      [&](std::size_t i, const Doubt& doubt) {
        MeasuredLink& measured = links[first + i];
        const bool hidden = measured.list == OccluderLists::hidden;
        if (measured.link.exchange > 0.0f || (measured.variation.sampling > 0.0f && !hidden)) {
          measured.variation.doubt = doubt;
          links[kept++] = measured;
          return true;
        }
        if (!hidden) { result.doubt.add(measured.link.p, measured.link.q, doubt); }
        return false;
      },
      [](std::size_t) {});
  links.resize(kept);
  return result;
}

}  // namespace radiosity
