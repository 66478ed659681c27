// SPDX-License-Identifier: MIT
#pragma once

// The error of a link, and of the whole, estimated from what the links cannot express (LinkShape) times the radiosity that they carry
// (paper 4.4). For p receiving from q, with the irradiance H = G B_q / A_p and the deviation S = G s_q / A_p, s_q the standard deviation of
// B over q's leaves:
//
//     e_p^2 = A_p rho^2 H^2 (rest_p^2 + shadow_p^2 + [p is a leaf] (leaf_linear linear_p)^2)     mends: splitting p
//           + A_p rho^2 S^2 (rest_q^2 + shadow_q^2)                                             mends: splitting q
//           + A_p rho^2 (sampling B_q / A_p)^2                                                   mends: splitting the larger
//
// summed over the channels, and the same for q receiving from p. An inner node passes the linear part of the light on to its children;
// a leaf does not, but the picture interpolates between leaves. A cluster shows other faces to each direction: there the mean of B^2
// stands for the square of what it sends, the noise of sampling is mended by splitting the source, and the S of different links of one
// node add up as they are, for each mixes bright faces with dark ones in the same way. The estimate of the whole is sqrt(sum of all e^2)
// over the norm of the reflected radiosity: all other errors of different links count as independent.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/evaluate.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/links.hpp>
#include <radiosity/material.hpp>
#include <radiosity/parallel.hpp>

namespace radiosity {

namespace detail {

// What the split of each end of a link would mend, squared.
struct LinkError {
  float p = 0.0f, q = 0.0f;
  [[nodiscard]] float sum() const { return p + q; }
};

// The part of the linear variation over a leaf that the picture, which interpolates between leaves, still misses.
inline constexpr double leaf_linear = 0.35;

struct NodeLight {
  Color mean{0.0};
  Color variance{0.0};  // over the leaves of the node
};

// `radiosity`: of every node, inner nodes area averages.
inline std::vector<NodeLight> light_of_nodes(const Hierarchy& hierarchy, const std::vector<double>& area,
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

// The errors of all links, and the norm of the reflected radiosity, squared.
struct ErrorEstimation {
  std::vector<LinkError> links;
  double sum = 0.0;
  double norm = 0.0;

  [[nodiscard]] double relative() const { return norm > 0.0 ? std::sqrt(sum / norm) : 0.0; }
};

inline ErrorEstimation estimate_errors(const Hierarchy& hierarchy, const Exposure& exposure, const Links& links,
                                       const std::vector<LinkShape>& shapes, const std::vector<Color>& reflectance,
                                       const std::vector<Color>& emission, const std::vector<Color>& radiosity) {
  ErrorEstimation result;
  const std::vector<double>& area = exposure.area;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf()) { continue; }
    const Color reflected = radiosity[i] - emission[hierarchy[i].surface];
    result.norm += area[i] * glm::dot(reflected, reflected);
  }
  const std::vector<NodeLight> light = light_of_nodes(hierarchy, area, radiosity);
  std::vector<Color> of_clusters;  // mean reflectance
  const auto rho = [&](const Node& node) { return node.is_cluster() ? of_clusters[node.cluster] : reflectance[node.surface]; };
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    if (!node.is_cluster()) { continue; }
    if (of_clusters.size() <= node.cluster) { of_clusters.resize(node.cluster + 1, Color{0.0}); }
    Color sum{0.0};
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { sum += area[c] * rho(hierarchy[c]); }
    of_clusters[node.cluster] = area[i] > 0.0 ? sum / area[i] : sum;
  }
  const auto square = [](double x) { return x * x; };
  const auto unmended = [&](const LinkShape::End& shape, bool leaf) {  // of the light received
    return (leaf ? square(leaf_linear * shape.linear) : 0.0) + square(shape.rest) + square(shape.shadow);
  };
  const auto received = [&](double g2, std::uint32_t i) {  // squared, from a radiosity of 1
    const Color r = rho(hierarchy[i]);
    return g2 / area[i] * r * r;
  };
  const auto varies = [&](const LinkShape::End& shape) { return square(shape.rest) + square(shape.shadow); };
  // What node i receives from clusters by the wrong mixture of their faces: links of one node err alike.
  std::vector<double> alike(light.size(), 0.0);
  const auto mixture = [&](const Color& to, std::uint32_t from, const LinkShape::End& shape) {
    return std::sqrt(glm::dot(to, light[from].variance) * varies(shape));
  };
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto& [p, q] = std::pair{links[i].p, links[i].q};
    const double g2 = square(links[i].exchange);
    if (hierarchy[q].is_cluster()) { alike[p] += mixture(received(g2, p), q, shapes[i].q); }
    if (hierarchy[p].is_cluster()) { alike[q] += mixture(received(g2, q), p, shapes[i].p); }
  }
  result.links.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    const Node& p = hierarchy[link.p];
    const Node& q = hierarchy[link.q];
    const LinkShape& shape = shapes[i];
    const double g2 = square(link.exchange);
    const Color to_p = received(g2, link.p);
    const Color to_q = received(g2, link.q);
    const NodeLight& from_p = light[link.p];
    const NodeLight& from_q = light[link.q];
    const Color bright_p = from_p.mean * from_p.mean + (p.is_cluster() ? from_p.variance : Color{0.0});
    const Color bright_q = from_q.mean * from_q.mean + (q.is_cluster() ? from_q.variance : Color{0.0});
    double mend_p = glm::dot(to_p, bright_q) * unmended(shape.p, p.leaf());
    double mend_q = glm::dot(to_q, bright_p) * unmended(shape.q, q.leaf());
    mend_p += p.is_cluster() ? mixture(to_q, link.p, shape.p) * alike[link.q] : glm::dot(to_q, from_p.variance) * varies(shape.p);
    mend_q += q.is_cluster() ? mixture(to_p, link.q, shape.q) * alike[link.p] : glm::dot(to_p, from_q.variance) * varies(shape.q);
    if (shape.sampling > 0.0f) {
      const double noise = square(shape.sampling);
      const bool split_p = p.is_cluster() == q.is_cluster() ? p.radius >= q.radius : p.is_cluster();
      (q.is_cluster() || !split_p ? mend_q : mend_p) += glm::dot(received(noise, link.p), bright_q);
      (p.is_cluster() || split_p ? mend_p : mend_q) += glm::dot(received(noise, link.q), bright_p);
    }
    result.links[i] = {static_cast<float>(mend_p), static_cast<float>(mend_q)};
    result.sum += mend_p + mend_q;
  }
  return result;
}

// The relative error for links that were not made by BF-refinement: from at most 1024 links of lights and 3072 others, spread evenly; their
// shapes are found now.
inline double sampled_estimate(const LinkEvaluator& evaluator, const Hierarchy& hierarchy, const Exposure& exposure, const Links& links,
                               const std::vector<Color>& reflectance, const std::vector<Color>& emission,
                               const std::vector<Color>& radiosity, unsigned threads) {
  const auto emits = [&](std::uint32_t i) { return !hierarchy[i].is_cluster() && !is_black(emission[hierarchy[i].surface]); };
  std::vector<std::uint32_t> of_lights, others;
  for (std::uint32_t i = 0; i < links.size(); ++i) { (emits(links[i].p) || emits(links[i].q) ? of_lights : others).push_back(i); }
  const auto squared = [&](const std::vector<std::uint32_t>& from, std::size_t most) {
    const std::size_t count = std::min(from.size(), most);
    Links sample(count);
    std::vector<LinkShape> shapes(count);
    parallel_for(count, threads, [&](std::size_t i) {
      sample[i] = links[from[i * from.size() / count]];
      const float closed = sample[i].exchange;
      (void)evaluator(sample[i], {}, &shapes[i]);
      sample[i].exchange = closed;
    });
    const ErrorEstimation errors = estimate_errors(hierarchy, exposure, sample, shapes, reflectance, emission, radiosity);
    const double relative = errors.relative();
    return count > 0 ? relative * relative * static_cast<double>(from.size()) / static_cast<double>(count) : 0.0;
  };
  return std::sqrt(squared(of_lights, 1024) + squared(others, 3072));
}

}  // namespace detail

}  // namespace radiosity
