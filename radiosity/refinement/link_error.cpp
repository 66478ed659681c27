// SPDX-License-Identifier: MIT
#include <radiosity/refinement/link_error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/exchange/exchange.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/leaf_error.hpp>
#include <radiosity/refinement/link_error_terms.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE ErrorEstimation estimate_link_errors(const AlikeErrors& alike, const DiscreteScene& scene, const MeasuredLinks& links,
                                                      const std::vector<Color>& radiosity) {
  ErrorEstimation result;
  const Hierarchy& hierarchy = scene.hierarchy;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf()) { continue; }
    const Color reflected = radiosity[i] - scene.emission[hierarchy[i].surface];
    result.norm += scene.exposure.area[i] * glm::dot(reflected, reflected);
  }
  LinkErrorTerms errors{alike, scene, radiosity};
  for (const MeasuredLink& l : links) { errors.add_to_nodes(l.link, l.variation); }
  result.links.reserve(links.size());
  for (const MeasuredLink& l : links) {
    const LinkErrorTerms::Terms terms = errors.of(l.link, l.variation);
    result.links.push_back({static_cast<float>(terms.p), static_cast<float>(terms.q)});
    result.of_links += terms.p + terms.q;
    if (!(l.link.exchange > 0.0f)) { result.unseen += terms.p + terms.q; }
  }
  return result;
}

// A sample of links for measuring.
struct LinkSample {
  std::vector<std::uint32_t> from;  // indices of the links from which it is drawn
  MeasuredLinks links;
  std::vector<double> each;  // number of links that each sampled one represents
};

// Two tables of links with a common index.
struct LinkTables {
  std::array<std::span<const Link>, 2> tables;

  [[nodiscard]] std::size_t size() const { return tables[0].size() + tables[1].size(); }
  [[nodiscard]] const Link& operator[](std::size_t i) const {
    return i < tables[0].size() ? tables[0][i] : tables[1][i - tables[0].size()];
  }
};

// Divides the links into: those with a light at one end, others of the first table, others of the second one (made by rays). Nothing is
// measured yet.
[[nodiscard]] HALFLIGHT_INLINE std::array<LinkSample, 3> lights_and_others(const DiscreteScene& scene, const LinkTables& links) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const auto emits = [&](std::uint32_t i) {
    return hierarchy[i].is_cluster() ? !scene.clustered() : !is_black(scene.emission[hierarchy[i].surface]);
  };
  std::array<LinkSample, 3> samples;
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    samples[emits(links[i].p) || emits(links[i].q) ? 0 : i < links.tables[0].size() ? 1 : 2].from.push_back(i);
  }
  return samples;
}

// Cumulative probabilities of the links in `sample.from`, with a sum of 1: a third by the scale of the squared error, a third by its
// upper bound, a third uniform. A purely uniform sample would miss the few links that carry most of the light, or weight them hundreds of
// times.
HALFLIGHT_INLINE std::vector<double> drawn_by(const LinkErrorTerms& errors, const LinkTables& links, const LinkSample& sample) {
  std::vector<LinkErrorTerms::Carried> carried(sample.from.size());
  LinkErrorTerms::Carried all;
  for (std::size_t i = 0; i < carried.size(); ++i) {
    carried[i] = errors.carried(links[sample.from[i]]);
    all.squared += carried[i].squared;
    all.most += carried[i].most;
  }
  const double even = 1.0 / static_cast<double>(carried.size());
  std::vector<double> sums(carried.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < carried.size(); ++i) {
    const double squared = all.squared > 0.0 ? carried[i].squared / all.squared : even;
    sums[i] = sum += (squared + (all.most > 0.0 ? carried[i].most / all.most : even) + even) / 3.0;
  }
  return sums;
}

// Sets the variation over an end by contour integral, for adjacent patches. Leaves have no gradient; on an inner node the deviation of
// the link's actual gradient counts as error.
HALFLIGHT_INLINE void by_contour(const DiscreteScene& scene, std::uint32_t i, std::uint32_t other, const glm::dvec3& slope,
                                 LinkVariation::End& end) {
  const Patch& patch = scene.patches[i];
  const Variation light = variation_by_contour(patch, scene.patches[other]);
  const double off = scene.hierarchy[i].leaf() ? 0.0 : mean_square(patch, light.slope - slope);
  end.linear = static_cast<float>(light.linear);
  end.rest = static_cast<float>(std::sqrt(light.rest * light.rest + off));
}

// Measures at most `most` links: all of them, or a systematic sample (Madow 1949) by their cumulative probability. Leaves the exchange
// unchanged.
HALFLIGHT_INLINE void measure_sample(const DiscreteScene& scene, const LinkErrorTerms& errors, const LinkTables& links, std::size_t most,
                                     LinkSample& sample) {
  std::vector<std::uint32_t> chosen;
  if (sample.from.size() <= most) {
    chosen = sample.from;
    sample.each.assign(chosen.size(), 1.0);
  } else {
    const std::vector<double> sums = drawn_by(errors, links, sample);
    const double step = sums.back() / static_cast<double>(most);
    std::size_t steps = 0;  // steps taken before link i
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::size_t before = steps;
      while (steps < most && (static_cast<double>(steps) + 0.5) * step < sums[i]) { ++steps; }
      if (steps == before) { continue; }
      chosen.push_back(sample.from[i]);
      sample.each.push_back(static_cast<double>(steps - before) * step / (sums[i] - (i > 0 ? sums[i - 1] : 0.0)));
    }
  }
  sample.links.resize(chosen.size());
  parallel_for(chosen.size(), scene.threads, [&](std::size_t i) {
    Link& link = sample.links[i].link = links[chosen[i]];
    const float closed = link.exchange;
    LinkVariation& variation = sample.links[i].variation;
    (void)scene.evaluator(link, {}, &variation);
    if (scene.evaluator.between_patches(link) && too_near_for_kernel(scene.patches[link.p], scene.patches[link.q])) {
      by_contour(scene, link.p, link.q, link.shape_p.gradient(), variation.p);
      by_contour(scene, link.q, link.p, link.shape_q.gradient(), variation.q);
    }
    link.exchange = closed;
  });
}

// The sum of the squared errors of all links that the sample represents.
HALFLIGHT_INLINE double sum_over(const LinkSample& sample, const ErrorEstimation& errors) {
  double sum = 0.0;
  for (std::size_t i = 0; i < errors.links.size(); ++i) {
    sum += sample.each[i] * (static_cast<double>(errors.links[i].p) + static_cast<double>(errors.links[i].q));
  }
  return sum;
}

// The errors of leaves, estimated from samples of the links.
HALFLIGHT_INLINE LeafErrors sampled_leaf_errors(const DiscreteScene& scene, std::initializer_list<const LinkSample*> samples,
                                                std::size_t all_links, const std::vector<Color>& radiosity) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  // Share of a linear variation over a node that remains within its leaves: the sum of their squared areas over its own squared area.
  std::vector<double> over_leaves(hierarchy.size(), 0.0);
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    if (node.leaf()) { over_leaves[i] = area[i] * area[i]; }
    for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) { over_leaves[i] += over_leaves[k]; }
  }
  LeafErrors leaves;
  Links sampled;
  std::vector<double> each;  // number of links that each sampled one represents
  for (const LinkSample* sample : samples) {
    const auto arrives = [&](std::uint32_t i, std::uint32_t sender, double exchange, float linear, double times) {
      if (hierarchy[i].is_cluster() || !(area[i] > 0.0)) { return; }
      const Color light = exchange / area[i] * double{linear} * scene.reflectance[hierarchy[i].surface] * radiosity[sender];
      leaves.apart += times * over_leaves[i] / area[i] * glm::dot(light, light);
    };
    for (std::size_t k = 0; k < sample->links.size(); ++k) {
      const auto& [link, list, variation] = sample->links[k];
      sampled.push_back(link);
      each.push_back(sample->each[k]);
      arrives(link.p, link.q, static_cast<double>(link.exchange), variation.p.linear, sample->each[k]);
      arrives(link.q, link.p, static_cast<double>(link.exchange), variation.q.linear, sample->each[k]);
    }
  }
  // A leaf that is a whole input face has no siblings, so its gradient is used. If the sample contains all links, the gradients
  // are exact enough for all leaves.
  LeafErrors by_gradients = estimate_leaf_errors(scene, sampled, radiosity, each);
  if (sampled.size() == all_links) { return by_gradients; }
  leaves.sum = variation_by_siblings(hierarchy, area, radiosity);
  double of_faces = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { of_faces += is_input_face(hierarchy, i) ? by_gradients.squares[i] : 0.0f; }
  leaves.sum += std::max(0.0, of_faces);
  return leaves;
}

// The sum of the squared errors of all pairs whose segments were all blocked. A single pair may let pass the share m = 1/18 of the light
// that 16 blocked segments leave possible (Laplace's mean), but most pairs let nothing pass. So each sampled pair is measured with as
// many segments once more, which gives the mean share f of all pairs, again by Laplace. f is at most a few m for any pair, so the mean of
// f^2 is about m f.
[[nodiscard]] HALFLIGHT_INLINE double sum_over_unseen(const DiscreteScene& scene, const LinkSample& sample, const ErrorEstimation& errors) {
  const LinkEvaluator again = scene.evaluator.reseeded(scene.seed ^ 0x756e7365656eull);
  constexpr double one_round = segments_per_round;
  std::vector<double> passes(sample.links.size(), 0.0);
  parallel_for(passes.size(), scene.threads, [&](std::size_t i) {
    Link link = sample.links[i].link;
    LinkVariation variation;
    const auto before = static_cast<double>(scene.evaluator(link, {}, &variation).cast);
    const double sent = static_cast<double>(variation.sampling) * (std::min(before, one_round) + 2.0);
    (void)again(link, {});
    passes[i] = sent > 0.0 ? std::min(1.0, static_cast<double>(link.exchange) / sent) : 0.0;
  });
  double sum = 0.0, squares = 0.0, passing = 0.0;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const double square = sample.each[i] * (static_cast<double>(errors.links[i].p) + static_cast<double>(errors.links[i].q));
    sum += square;
    squares += square * square;
    passing += square * passes[i];
  }
  if (!(sum > 0.0)) { return 0.0; }
  const double segments = one_round * sum * sum / squares;  // effective number for pairs of equal importance
  const double share = (segments * passing / sum + 1.0) / (segments + 2.0);
  return sum * share * (one_round + 2.0);
}

// Adds the errors of pairs whose segments were all blocked.
HALFLIGHT_INLINE void add_unseen(const DiscreteScene& scene, const PairSample& unseen, const AlikeErrors& alike,
                                 const std::vector<Color>& radiosity, ErrorEstimation& result) {
  Links pairs;
  for (const glm::uvec2& pair : unseen.pairs()) {
    pairs.emplace_back();
    pairs.back().p = pair.x;
    pairs.back().q = pair.y;
  }
  auto [of_lights, others, no_rays] = lights_and_others(scene, {{pairs, {}}});
  const LinkErrorTerms terms{alike, scene, radiosity};
  measure_sample(scene, terms, {{pairs, {}}}, 1024, of_lights);
  measure_sample(scene, terms, {{pairs, {}}}, 1024, others);
  for (const LinkSample* sample : {&of_lights, &others}) {
    const ErrorEstimation errors = estimate_link_errors(alike, scene, sample->links, radiosity);
    result.unseen += static_cast<double>(unseen.each()) * sum_over_unseen(scene, *sample, errors);
  }
  result.of_links += result.unseen;
}

HALFLIGHT_INLINE ErrorEstimation sampled_estimate(const DiscreteScene& scene, const std::array<std::span<const Link>, 2>& tables,
                                                  const std::vector<Color>& radiosity, const EvaluateResult& evaluated) {
  const LinkTables links{tables};
  auto [of_lights, others, of_rays] = lights_and_others(scene, links);
  const AlikeErrors independent;
  const LinkErrorTerms terms{independent, scene, radiosity};
  measure_sample(scene, terms, links, 1024, of_lights);
  measure_sample(scene, terms, links, 3072, others);
  measure_sample(scene, terms, links, 3072, of_rays);
  const LeafErrors leaves = sampled_leaf_errors(scene, {&of_lights, &others, &of_rays}, links.size(), radiosity);
  ErrorEstimation result;
  result.of_leaves = leaves.sum;
  const AlikeErrors alike{std::sqrt(evaluated.doubt.alike(scene.hierarchy, scene.exposure.area)), leaves.alike()};
  // The ratio from the row sums applies to evaluated links only. Rays make thousands of links at a node, at different places in
  // front of it, which are independent.
  const AlikeErrors of_ray_links{1.0, leaves.alike()};
  for (const LinkSample* sample : {&of_lights, &others, &of_rays}) {
    const AlikeErrors& together = sample == &of_rays ? of_ray_links : alike;
    const ErrorEstimation errors = estimate_link_errors(together, scene, sample->links, radiosity);
    result.of_links += sum_over(*sample, errors);
    result.norm = errors.norm;
  }
  add_unseen(scene, evaluated.unseen, alike, radiosity, result);
  return result;
}

HALFLIGHT_INLINE std::string estimate_doubt(const DiscreteScene& scene, Transport& transport, const std::vector<Color>& radiosity,
                                            double estimate, double unseen, bool closed) {
  const Hierarchy& hierarchy = scene.hierarchy;
  constexpr double most_estimate = 0.5, most_unseen = 0.5;
  constexpr double most_growth = 5.0;
  if (unseen > most_unseen) { return "no bound: most of it is light that may pass where no segment did"; }
  if (estimate > most_estimate) { return "no bound: more than half of the light that it is relative to may be error"; }
  if (closed) { return {}; }
  double once = 0.0;
  double all = 0.0;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> sent(hierarchy.size(), 0.0);
    std::vector<double> arrived;
    for (std::size_t i = 0; i < hierarchy.size(); ++i) {
      if (hierarchy[i].leaf()) { sent[i] = scene.emission[hierarchy[i].surface][c]; }
    }
    transport.apply(sent, arrived);
    for (std::size_t i = 0; i < hierarchy.size(); ++i) {
      if (!hierarchy[i].leaf()) { continue; }
      once += scene.reflectance[hierarchy[i].surface][c] * arrived[i];
      all += scene.exposure.area[i] * (radiosity[i][c] - sent[i]);
    }
  }
  if (!(all > most_growth * once)) { return {}; }
  return "no bound: light is reflected many times, and errors grow with it";
}

}  // namespace detail

}  // namespace radiosity
