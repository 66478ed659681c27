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

#include <raycast/inline.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/leaf_error.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/support/parallel.hpp>

namespace radiosity {

namespace detail {

struct NodeLight {
  Color mean{0.0};
  Color variance{0.0};  // over the leaves of the node
};

// `radiosity`: of every node, inner nodes area averages.
HALFLIGHT_INLINE std::vector<NodeLight> light_of_nodes(const Hierarchy& hierarchy, const std::vector<double>& area,
                                                       const std::vector<Color>& radiosity) {
  std::vector<NodeLight> light(hierarchy.size());
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    light[i].mean = radiosity[i];
    const Node& node = hierarchy[i];
    if (node.leaf() || !(area[i] > 0.0)) { continue; }
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      const Color off = radiosity[c] - radiosity[i];
      light[i].variance += area[c] / area[i] * (light[c].variance + off * off);
    }
  }
  return light;
}

// The terms of a link's squared error (link_error.hpp).
class LinkErrorTerms {
 public:
  LinkErrorTerms(const AlikeErrors& alike, const DiscreteScene& scene, const std::vector<Color>& radiosity)
      : alike_{alike},
        scene_{scene},
        area_{scene.exposure.area},
        light_{light_of_nodes(scene.hierarchy, area_, radiosity)},
        mixtures_(light_.size(), 0.0),
        rests_(light_.size(), 0.0) {
    const Hierarchy& hierarchy = scene.hierarchy;
    for (std::size_t i = hierarchy.size(); i-- > 0;) {
      const Node& node = hierarchy[i];
      if (!node.is_cluster()) { continue; }
      if (of_clusters_.size() <= node.cluster) { of_clusters_.resize(node.cluster + 1, Color{0.0}); }
      Color sum{0.0};
      for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { sum += area_[c] * rho(hierarchy[c]); }
      of_clusters_[node.cluster] = area_[i] > 0.0 ? sum / area_[i] : sum;
    }
  }

  // To be called for all links before of() is called for any.
  void add_to_nodes(const Link& link, const LinkVariation& variation) {
    const std::uint32_t p = link.p, q = link.q;
    const double g2 = square(link.exchange);
    if (scene_.hierarchy[q].is_cluster()) { mixtures_[p] += mixture(received(g2, p), q, variation.q); }
    if (scene_.hierarchy[p].is_cluster()) { mixtures_[q] += mixture(received(g2, q), p, variation.p); }
    if (alike_.across) { return; }
    rests_[p] += rest(received(g2, p), q, variation.p);
    rests_[q] += rest(received(g2, q), p, variation.q);
  }

  struct Terms {
    double p = 0.0, q = 0.0;  // reduced by splitting that end
  };
  // The terms of one link.
  [[nodiscard]] Terms of(const Link& link, const LinkVariation& variation) const {
    const Node& p = scene_.hierarchy[link.p];
    const Node& q = scene_.hierarchy[link.q];
    const double g2 = square(link.exchange);
    const Color to_p = received(g2, link.p);
    const Color to_q = received(g2, link.q);
    // At most 1: a link that lit each place from one other alone would pass on s_q itself.
    const double cross = std::min(1.0, square(variation.cross));
    Terms terms{over(to_p, link.q, link.p, variation.p), over(to_q, link.p, link.q, variation.q)};
    terms.p += p.is_cluster() ? mixture(to_q, link.p, variation.p) * mixtures_[link.q]
                              : glm::dot(to_q, light_[link.p].variance) * (varies(variation.p) + cross);
    terms.q += q.is_cluster() ? mixture(to_p, link.q, variation.q) * mixtures_[link.p]
                              : glm::dot(to_p, light_[link.q].variance) * (varies(variation.q) + cross);
    if (variation.sampling > 0.0f) {
      const double noise = square(variation.sampling);
      const bool split_p = p.is_cluster() == q.is_cluster() ? p.radius >= q.radius : p.is_cluster();
      (q.is_cluster() || !split_p ? terms.q : terms.p) += glm::dot(received(noise, link.p), bright(link.q));
      (p.is_cluster() || split_p ? terms.p : terms.q) += glm::dot(received(noise, link.q), bright(link.p));
    }
    return terms;
  }

 private:
  [[nodiscard]] static double square(double x) { return x * x; }
  [[nodiscard]] static double varies(const LinkVariation::End& end) { return square(end.rest) + square(end.shadow); }
  [[nodiscard]] const Color& rho(const Node& node) const {
    return node.is_cluster() ? of_clusters_[node.cluster] : scene_.reflectance[node.surface];
  }
  // What node i reflects of a radiosity of 1, squared; g2: the exchange, squared.
  [[nodiscard]] Color received(double g2, std::uint32_t i) const {
    const Color r = rho(scene_.hierarchy[i]);
    return area_[i] > 0.0 ? g2 / area_[i] * r * r : Color{0.0};
  }
  // Mean of B^2: a cluster shows other faces to each direction.
  [[nodiscard]] Color bright(std::uint32_t from) const {
    return light_[from].mean * light_[from].mean + (scene_.hierarchy[from].is_cluster() ? light_[from].variance : Color{0.0});
  }
  // Error by the wrong mixture of the faces of a cluster.
  [[nodiscard]] double mixture(const Color& to, std::uint32_t from, const LinkVariation::End& end) const {
    return std::sqrt(glm::dot(to, light_[from].variance) * varies(end));
  }
  [[nodiscard]] double rest(const Color& to, std::uint32_t from, const LinkVariation::End& end) const {
    return static_cast<double>(end.rest) * std::sqrt(glm::dot(to, bright(from)));
  }
  // What a link from `from` adds to the squared error over node i.
  [[nodiscard]] double over(const Color& to, std::uint32_t from, std::uint32_t i, const LinkVariation::End& end) const {
    const double own = rest(to, from, end);
    const bool apart = scene_.hierarchy[i].leaf() || scene_.hierarchy[i].is_cluster();
    const double all = apart ? own * own : alike_.across ? *alike_.across * own * own : own * rests_[i];
    return std::min(1.0, alike_.at_leaves) * all + square(end.shadow) * glm::dot(to, bright(from));
  }

  const AlikeErrors& alike_;
  const DiscreteScene& scene_;
  const std::vector<double>& area_;
  std::vector<NodeLight> light_;
  std::vector<Color> of_clusters_;  // mean reflectance
  // Of each node, the sums over its links, which err alike there: by wrong mixtures of clusters' faces, and the rests.
  std::vector<double> mixtures_, rests_;
};

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

// A sample of links, spread evenly over them, that are measured.
struct LinkSample {
  std::vector<std::uint32_t> from;  // indices of the links
  MeasuredLinks links;
  double each = 0.0;  // links that one stands for
};

// Links in two tables, as if in one.
struct LinkTables {
  std::array<std::span<const Link>, 2> tables;

  [[nodiscard]] std::size_t size() const { return tables[0].size() + tables[1].size(); }
  [[nodiscard]] const Link& operator[](std::size_t i) const {
    return i < tables[0].size() ? tables[0][i] : tables[1][i - tables[0].size()];
  }
};

// Those that hold a light at an end, and those that do not; nothing is measured yet.
[[nodiscard]] HALFLIGHT_INLINE std::array<LinkSample, 2> lights_and_others(const DiscreteScene& scene, const LinkTables& links) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const auto emits = [&](std::uint32_t i) {
    return hierarchy[i].is_cluster() ? !scene.clustered() : !is_black(scene.emission[hierarchy[i].surface]);
  };
  std::array<LinkSample, 2> samples;
  for (std::uint32_t i = 0; i < links.size(); ++i) { samples[emits(links[i].p) || emits(links[i].q) ? 0 : 1].from.push_back(i); }
  return samples;
}

// Measures `most` of the links at most. The exchange stays as it is.
HALFLIGHT_INLINE void measure_sample(const DiscreteScene& scene, const LinkTables& links, std::size_t most, LinkSample& sample) {
  const std::size_t count = std::min(sample.from.size(), most);
  sample.links.resize(count);
  parallel_for(count, scene.threads, [&](std::size_t i) {
    Link& link = sample.links[i].link = links[sample.from[i * sample.from.size() / count]];
    const float closed = link.exchange;
    (void)scene.evaluator(link, {}, &sample.links[i].variation);
    link.exchange = closed;
  });
  sample.each = count > 0 ? static_cast<double>(sample.from.size()) / static_cast<double>(count) : 0.0;
}

// The errors of leaves, from samples of the links.
HALFLIGHT_INLINE LeafErrors sampled_leaf_errors(const DiscreteScene& scene, std::initializer_list<const LinkSample*> samples,
                                                std::size_t all_links, const std::vector<Color>& radiosity) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  // The part of a linear variation over a node that is left over its leaves: the sum of the squares of their areas over that of its own.
  std::vector<double> over_leaves(hierarchy.size(), 0.0);
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    if (node.leaf()) { over_leaves[i] = area[i] * area[i]; }
    for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) { over_leaves[i] += over_leaves[k]; }
  }
  LeafErrors leaves;
  Links scaled;  // as if they were all
  for (const LinkSample* sample : samples) {
    const auto arrives = [&](std::uint32_t i, std::uint32_t sender, double exchange, float linear) {
      if (hierarchy[i].is_cluster() || !(area[i] > 0.0)) { return; }
      const Color light = exchange / area[i] * double{linear} * scene.reflectance[hierarchy[i].surface] * radiosity[sender];
      leaves.apart += sample->each * over_leaves[i] / area[i] * glm::dot(light, light);
    };
    for (const auto& [link, list, variation] : sample->links) {
      scaled.push_back(link);
      scaled.back().exchange *= static_cast<float>(sample->each);
      arrives(link.p, link.q, static_cast<double>(link.exchange), variation.p.linear);
      arrives(link.q, link.p, static_cast<double>(link.exchange), variation.q.linear);
    }
  }
  // A leaf that is a whole input face has no siblings; and where the sample is all the links, their gradients tell more.
  LeafErrors by_gradients = estimate_leaf_errors(scene, scaled, radiosity);
  if (scaled.size() == all_links) { return by_gradients; }
  leaves.sum = variation_by_siblings(hierarchy, area, radiosity);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { leaves.sum += is_input_face(hierarchy, i) ? by_gradients.squares[i] : 0.0f; }
  return leaves;
}

// What may pass where no segment did.
HALFLIGHT_INLINE void add_unseen(const DiscreteScene& scene, const PairSample& unseen, const AlikeErrors& alike,
                                 const std::vector<Color>& radiosity, ErrorEstimation& result) {
  Links pairs;
  for (const glm::uvec2& pair : unseen.pairs()) {
    pairs.emplace_back();
    pairs.back().p = pair.x;
    pairs.back().q = pair.y;
  }
  auto [of_lights, others] = lights_and_others(scene, {{pairs, {}}});
  measure_sample(scene, {{pairs, {}}}, 1024, of_lights);
  measure_sample(scene, {{pairs, {}}}, 1024, others);
  for (const LinkSample* sample : {&of_lights, &others}) {
    const double squares = estimate_link_errors(alike, scene, sample->links, radiosity).of_links;
    result.unseen += static_cast<double>(unseen.each()) * sample->each * squares;
  }
  result.of_links += result.unseen;
}

HALFLIGHT_INLINE ErrorEstimation sampled_estimate(const DiscreteScene& scene, const std::array<std::span<const Link>, 2>& tables,
                                                  const std::vector<Color>& radiosity, const EvaluateResult& evaluated) {
  const LinkTables links{tables};
  auto [of_lights, others] = lights_and_others(scene, links);
  measure_sample(scene, links, 1024, of_lights);
  measure_sample(scene, links, 3072, others);
  const LeafErrors leaves = sampled_leaf_errors(scene, {&of_lights, &others}, links.size(), radiosity);
  ErrorEstimation result;
  result.of_leaves = leaves.sum;
  const AlikeErrors alike{std::sqrt(evaluated.doubt.alike(scene.hierarchy, scene.exposure.area)), leaves.alike()};
  for (const LinkSample* sample : {&of_lights, &others}) {
    const ErrorEstimation errors = estimate_link_errors(alike, scene, sample->links, radiosity);
    result.of_links += sample->each * errors.of_links;
    result.norm = errors.norm;
  }
  add_unseen(scene, evaluated.unseen, alike, radiosity, result);
  return result;
}

HALFLIGHT_INLINE std::string estimate_doubt(const DiscreteScene& scene, Transport& transport, const std::vector<Color>& radiosity,
                                            double unseen, bool closed) {
  const Hierarchy& hierarchy = scene.hierarchy;
  constexpr double most_unseen = 0.5;
  constexpr double most_growth = 5.0;
  if (unseen > most_unseen) { return "no bound: most of it is light that may pass where no segment did"; }
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
