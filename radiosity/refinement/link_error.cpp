// SPDX-License-Identifier: MIT
#include <radiosity/refinement/link_error.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
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

HALFLIGHT_INLINE ErrorEstimation estimate_link_errors(std::optional<double> alike_across, double alike_at_leaves,
                                                      const DiscreteScene& scene, const MeasuredLinks& links,
                                                      const std::vector<Color>& radiosity) {
  ErrorEstimation result;
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf()) { continue; }
    const Color reflected = radiosity[i] - scene.emission[hierarchy[i].surface];
    result.norm += area[i] * glm::dot(reflected, reflected);
  }
  const std::vector<NodeLight> light = light_of_nodes(hierarchy, area, radiosity);
  std::vector<Color> of_clusters;  // mean reflectance
  const auto rho = [&](const Node& node) { return node.is_cluster() ? of_clusters[node.cluster] : scene.reflectance[node.surface]; };
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    if (!node.is_cluster()) { continue; }
    if (of_clusters.size() <= node.cluster) { of_clusters.resize(node.cluster + 1, Color{0.0}); }
    Color sum{0.0};
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { sum += area[c] * rho(hierarchy[c]); }
    of_clusters[node.cluster] = area[i] > 0.0 ? sum / area[i] : sum;
  }
  const auto square = [](double x) { return x * x; };
  const auto received = [&](double g2, std::uint32_t i) {  // squared, from a radiosity of 1
    const Color r = rho(hierarchy[i]);
    return area[i] > 0.0 ? g2 / area[i] * r * r : Color{0.0};
  };
  const auto varies = [&](const LinkVariation::End& end) { return square(end.rest) + square(end.shadow); };
  // What node i receives from clusters by the wrong mixture of their faces: links of one node err alike.
  std::vector<double> alike(light.size(), 0.0);
  const auto mixture = [&](const Color& to, std::uint32_t from, const LinkVariation::End& end) {
    return std::sqrt(glm::dot(to, light[from].variance) * varies(end));
  };
  const auto bright = [&](std::uint32_t from) {  // mean of B^2 where it counts
    return light[from].mean * light[from].mean + (hierarchy[from].is_cluster() ? light[from].variance : Color{0.0});
  };
  std::vector<double> across(light.size(), 0.0);  // rests of the links of each node
  const auto over_node = [&](const Color& to, std::uint32_t from, const LinkVariation::End& end) {
    return static_cast<double>(end.rest) * std::sqrt(glm::dot(to, bright(from)));
  };
  const double cancel = std::min(1.0, alike_at_leaves);
  // What a link from `from` adds to the squared error over node i.
  const auto over = [&](const Color& to, std::uint32_t from, std::uint32_t i, const LinkVariation::End& end) {
    const double own = over_node(to, from, end);
    const bool apart = hierarchy[i].leaf() || hierarchy[i].is_cluster();
    const double all = apart ? own * own : alike_across ? *alike_across * own * own : own * across[i];
    return cancel * all + square(end.shadow) * glm::dot(to, bright(from));
  };
  for (const auto& [link, list, variation] : links) {
    const std::uint32_t p = link.p, q = link.q;
    const double g2 = square(link.exchange);
    if (hierarchy[q].is_cluster()) { alike[p] += mixture(received(g2, p), q, variation.q); }
    if (hierarchy[p].is_cluster()) { alike[q] += mixture(received(g2, q), p, variation.p); }
    if (alike_across) { continue; }
    across[p] += over_node(received(g2, p), q, variation.p);
    across[q] += over_node(received(g2, q), p, variation.q);
  }
  result.links.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto& [link, list, variation] = links[i];
    const Node& p = hierarchy[link.p];
    const Node& q = hierarchy[link.q];
    const double g2 = square(link.exchange);
    const Color to_p = received(g2, link.p);
    const Color to_q = received(g2, link.q);
    const NodeLight& from_p = light[link.p];
    const NodeLight& from_q = light[link.q];
    // At most 1: a link that lit each place from one other alone would pass on s_q itself.
    const double cross = std::min(1.0, square(variation.cross));
    double mend_p = over(to_p, link.q, link.p, variation.p);
    double mend_q = over(to_q, link.p, link.q, variation.q);
    mend_p += p.is_cluster() ? mixture(to_q, link.p, variation.p) * alike[link.q]
                             : glm::dot(to_q, from_p.variance) * (varies(variation.p) + cross);
    mend_q += q.is_cluster() ? mixture(to_p, link.q, variation.q) * alike[link.p]
                             : glm::dot(to_p, from_q.variance) * (varies(variation.q) + cross);
    if (variation.sampling > 0.0f) {
      const double noise = square(variation.sampling);
      const bool split_p = p.is_cluster() == q.is_cluster() ? p.radius >= q.radius : p.is_cluster();
      (q.is_cluster() || !split_p ? mend_q : mend_p) += glm::dot(received(noise, link.p), bright(link.q));
      (p.is_cluster() || split_p ? mend_p : mend_q) += glm::dot(received(noise, link.q), bright(link.p));
    }
    result.links[i] = {static_cast<float>(mend_p), static_cast<float>(mend_q)};
    result.of_links += mend_p + mend_q;
    if (!(link.exchange > 0.0f)) { result.unseen += mend_p + mend_q; }
  }
  return result;
}

HALFLIGHT_INLINE ErrorEstimation sampled_estimate(const DiscreteScene& scene, const std::array<std::span<const Link>, 2>& links,
                                                  const std::vector<Color>& radiosity, const DoubtSum& doubt) {
  const std::size_t all = links[0].size() + links[1].size();
  const auto link_at = [&](std::size_t i) -> const Link& { return i < links[0].size() ? links[0][i] : links[1][i - links[0].size()]; };
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  const auto emits = [&](std::uint32_t i) { return !hierarchy[i].is_cluster() && !is_black(scene.emission[hierarchy[i].surface]); };
  struct Sample {
    std::vector<std::uint32_t> from;
    MeasuredLinks links;
    double each = 0.0;  // links that one stands for
  };
  Sample of_lights, others;
  for (std::uint32_t i = 0; i < all; ++i) { (emits(link_at(i).p) || emits(link_at(i).q) ? of_lights : others).from.push_back(i); }
  // The part of a linear variation over a node that is left over its leaves: the sum of the squares of their areas over that of its own.
  std::vector<double> over_leaves(hierarchy.size(), 0.0);
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    if (node.leaf()) { over_leaves[i] = area[i] * area[i]; }
    for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) { over_leaves[i] += over_leaves[k]; }
  }
  LeafErrors leaves;
  Links scaled;  // as if they were all
  const auto draw = [&](Sample& sample, std::size_t most) {
    const std::size_t count = std::min(sample.from.size(), most);
    sample.links.resize(count);
    parallel_for(count, scene.threads, [&](std::size_t i) {
      Link& link = sample.links[i].link = link_at(sample.from[i * sample.from.size() / count]);
      const float closed = link.exchange;
      (void)scene.evaluator(link, {}, &sample.links[i].variation);
      link.exchange = closed;
    });
    sample.each = count > 0 ? static_cast<double>(sample.from.size()) / static_cast<double>(count) : 0.0;
    const auto arrives = [&](std::uint32_t i, std::uint32_t sender, double exchange, float linear) {
      if (hierarchy[i].is_cluster() || !(area[i] > 0.0)) { return; }
      const Color light = exchange / area[i] * double{linear} * scene.reflectance[hierarchy[i].surface] * radiosity[sender];
      const double square = sample.each * over_leaves[i] / area[i] * glm::dot(light, light);
      leaves.apart += square;
    };
    for (const auto& [link, list, variation] : sample.links) {
      scaled.push_back(link);
      scaled.back().exchange *= static_cast<float>(sample.each);
      arrives(link.p, link.q, static_cast<double>(link.exchange), variation.p.linear);
      arrives(link.q, link.p, static_cast<double>(link.exchange), variation.q.linear);
    }
  };
  draw(of_lights, 1024);
  draw(others, 3072);
  // A leaf that is a whole input face has no siblings; and where the sample is all the links, their gradients tell more.
  const LeafErrors by_gradients = estimate_leaf_errors(scene, scaled, radiosity);
  if (scaled.size() == all) {
    leaves = by_gradients;
  } else {
    leaves.sum = variation_by_siblings(hierarchy, area, radiosity);
    for (std::size_t i = 0; i < hierarchy.size(); ++i) { leaves.sum += is_input_face(hierarchy, i) ? by_gradients.squares[i] : 0.0f; }
  }
  ErrorEstimation result;
  result.of_leaves = leaves.sum;
  for (const Sample* sample : {&of_lights, &others}) {
    const ErrorEstimation errors = estimate_link_errors(std::sqrt(doubt.alike(area)), leaves.alike(), scene, sample->links, radiosity);
    result.of_links += sample->each * errors.of_links;
    result.norm = errors.norm;
  }
  return result;
}

HALFLIGHT_INLINE std::string estimate_doubt(const DiscreteScene& scene, Transport& transport, const std::vector<Color>& radiosity,
                                            double unseen, bool closed) {
  const Hierarchy& hierarchy = scene.hierarchy;
  constexpr double most_unseen = 0.5;
  constexpr double most_growth = 5.0;
  if (unseen > most_unseen) { return "most of it is light that may pass where no segment did"; }
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
  return "light is reflected many times, and errors grow with it";
}

}  // namespace detail

}  // namespace radiosity
