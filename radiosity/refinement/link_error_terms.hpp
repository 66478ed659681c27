// SPDX-License-Identifier: MIT
#pragma once

// The terms of the squared error of one link (link_error.hpp), from its measured variation and the radiosity of its ends.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

// How errors of different links add up.
struct AlikeErrors {
  std::optional<double> across;  // for inner nodes: squared error relative to independent links; set if only a sample of the links is given
  double at_leaves = 1.0;        // LeafErrors::alike()
};

struct NodeLight {
  Color mean{0.0};
  Color variance{0.0};  // over the leaves of the node
};

// `radiosity`: by node; area averages for inner nodes.
[[nodiscard]] inline std::vector<NodeLight> light_of_nodes(const Hierarchy& hierarchy, const std::vector<double>& area,
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

  // Must be called for all links before of() is called for any.
  void add_to_nodes(const Link& link, const LinkVariation& measured) {
    const LinkVariation variation = possible(link, measured);
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
  [[nodiscard]] Terms of(const Link& link, const LinkVariation& measured) const {
    const LinkVariation variation = possible(link, measured);
    const Node& p = scene_.hierarchy[link.p];
    const Node& q = scene_.hierarchy[link.q];
    const double g2 = square(link.exchange);
    const Color to_p = received(g2, link.p);
    const Color to_q = received(g2, link.q);
    // At most 1, which is reached if each place receives light from a single place of the other end and so has the full deviation s_q.
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

  // Importance of a link for drawing a sample: `squared`, the scale of its squared error, and `most`, the scale of its upper bound by
  // possible().
  struct Carried {
    double squared = 0.0, most = 0.0;
  };
  [[nodiscard]] Carried carried(const Link& link) const {
    const double g = static_cast<double>(link.exchange);
    const auto sent = [&](std::uint32_t i) { return light_[i].mean * light_[i].mean + light_[i].variance; };
    const double to_p = glm::dot(received(g, link.p), sent(link.q)), to_q = glm::dot(received(g, link.q), sent(link.p));
    return {g * (to_p + to_q), area_[link.p] * to_p + area_[link.q] * to_q};
  }

 private:
  [[nodiscard]] static double square(double x) { return x * x; }
  // Limits measured variations to possible values. The form factor from each point of p to q is in [0, 1], so its mean square over p is
  // at most its mean G / A_p, and its relative variance at most A_p / G - 1. Measurements at few points beside a common edge may exceed
  // that a thousand times.
  [[nodiscard]] LinkVariation possible(const Link& link, const LinkVariation& measured) const {
    LinkVariation result = measured;
    const double g = static_cast<double>(link.exchange);
    const auto limit = [&](std::uint32_t i, LinkVariation::End& end) {
      if (g > 0.0) { end.rest = std::min(end.rest, static_cast<float>(std::sqrt(std::max(0.0, area_[i] / g - 1.0)))); }
    };
    limit(link.p, result.p);
    limit(link.q, result.q);
    return result;
  }
  [[nodiscard]] static double varies(const LinkVariation::End& end) { return square(end.rest) + square(end.shadow); }
  [[nodiscard]] const Color& rho(const Node& node) const {
    return node.is_cluster() ? of_clusters_[node.cluster] : scene_.reflectance[node.surface];
  }
  // The squared radiosity that node i reflects of a radiosity of 1; g2: squared exchange.
  [[nodiscard]] Color received(double g2, std::uint32_t i) const {
    const Color r = rho(scene_.hierarchy[i]);
    return area_[i] > 0.0 ? g2 / area_[i] * r * r : Color{0.0};
  }
  // Mean of B^2, because a cluster shows different faces in each direction.
  [[nodiscard]] Color bright(std::uint32_t from) const {
    return light_[from].mean * light_[from].mean + (scene_.hierarchy[from].is_cluster() ? light_[from].variance : Color{0.0});
  }
  // Error from the wrong mixture of a cluster's faces.
  [[nodiscard]] double mixture(const Color& to, std::uint32_t from, const LinkVariation::End& end) const {
    return std::sqrt(glm::dot(to, light_[from].variance) * varies(end));
  }
  [[nodiscard]] double rest(const Color& to, std::uint32_t from, const LinkVariation::End& end) const {
    return static_cast<double>(end.rest) * std::sqrt(glm::dot(to, bright(from)));
  }
  // The squared error over node i that a link from `from` adds.
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
  // By node: sums over its links, which err alike: of the mixture errors, and of the rests.
  std::vector<double> mixtures_, rests_;
};

}  // namespace detail

}  // namespace radiosity
