// SPDX-License-Identifier: MIT
#pragma once

// The relative L2 error of a solution, estimated from what its links cannot express (LinkShape) times the radiosity that they carry
// (paper 4.4), and from what its leaves cannot. For p receiving from q, with the irradiance H = G B_q / A_p and the deviation
// S = G s_q / A_p, s_q the standard deviation of B over q's leaves:
//
//     e_p^2 = A_p rho^2 H^2 (rest_p^2 + shadow_p^2)                        mends: splitting p
//           + A_p rho^2 S^2 (rest_q^2 + shadow_q^2 + cross^2)              mends: splitting q
//           + A_p rho^2 (sampling B_q / A_p)^2                             mends: splitting the larger
//
// summed over the channels, and the same for q receiving from p. A link passes the linear part of its light on to the leaves below; but a
// leaf i has one constant. With g_i the gradient of the irradiance that all links at i and above it bring there, as vectors,
//
//     e_i^2 = A_i rho^2 (mean over i of (g_i . (x - c_i))^2)               mends: splitting i, while its links stay
//
// which is an error of the constants; of a picture, that interpolates between leaves, a part of it (leaf_part). On curved objects the
// gradient holds the turn of the normals.
//
// A cluster shows other faces to each direction: there the mean of B^2 stands for the square of what it sends, the noise of sampling is
// mended by splitting the source, and the S of different links of one node add up as they are, for each mixes bright faces with dark ones
// in the same way. The estimate of the whole is sqrt(sum of all e^2) over the norm of the reflected radiosity: all other errors of
// different links count as independent.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/evaluate.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/links.hpp>
#include <radiosity/material.hpp>
#include <radiosity/occlusion.hpp>
#include <radiosity/options.hpp>
#include <radiosity/parallel.hpp>

namespace radiosity {

namespace detail {

// What the split of each end of a link would mend, squared.
struct LinkError {
  float p = 0.0f, q = 0.0f;
  [[nodiscard]] float sum() const { return p + q; }
};

// How much of the variation over a leaf is an error: all of it, or the part that a picture which interpolates still misses.
[[nodiscard]] constexpr double leaf_part(Reconstruction kind) { return kind >= Reconstruction::constant ? 1.0 : 0.35; }

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

// All squared.
struct ErrorEstimation {
  std::vector<LinkError> links;
  std::vector<float> leaves;  // by the variation over each leaf; one a node
  double of_links = 0.0, of_leaves = 0.0;
  double norm = 0.0;  // of the reflected radiosity

  [[nodiscard]] double sum(double part) const { return of_links + part * part * of_leaves; }
  [[nodiscard]] double relative(double part) const { return norm > 0.0 ? std::sqrt(sum(part) / norm) : 0.0; }
};

// The errors of links alone, and the norm.
inline ErrorEstimation estimate_link_errors(const Hierarchy& hierarchy, const Exposure& exposure, const Links& links,
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
    const double cross = std::min(1.0, square(shape.cross));  // a link that lit each place from one other alone would pass on s_q itself
    double mend_p = glm::dot(to_p, bright_q) * varies(shape.p);
    double mend_q = glm::dot(to_q, bright_p) * varies(shape.q);
    mend_p += p.is_cluster() ? mixture(to_q, link.p, shape.p) * alike[link.q] : glm::dot(to_q, from_p.variance) * (varies(shape.p) + cross);
    mend_q += q.is_cluster() ? mixture(to_p, link.q, shape.q) * alike[link.p] : glm::dot(to_p, from_q.variance) * (varies(shape.q) + cross);
    if (shape.sampling > 0.0f) {
      const double noise = square(shape.sampling);
      const bool split_p = p.is_cluster() == q.is_cluster() ? p.radius >= q.radius : p.is_cluster();
      (q.is_cluster() || !split_p ? mend_q : mend_p) += glm::dot(received(noise, link.p), bright_q);
      (p.is_cluster() || split_p ? mend_p : mend_q) += glm::dot(received(noise, link.q), bright_p);
    }
    result.links[i] = {static_cast<float>(mend_p), static_cast<float>(mend_q)};
    result.of_links += mend_p + mend_q;
  }
  return result;
}

// Mean over a patch of the square of g . (x - c).
inline double mean_square(const Patch& patch, const glm::dvec3& g) {
  double sum = 0.0;
  for (const QuadraturePoint& x : patch.rule3) { sum += x.weight * glm::dot(g, x.position - patch.centroid) * glm::dot(g, x.position - patch.centroid); }
  return patch.area > 0.0 ? sum / patch.area : 0.0;
}

// Adds the errors of leaves to those of the links. The links have their slopes, at leaves too.
inline void add_leaf_errors(const Hierarchy& hierarchy, const Patches& patches, const Exposure& exposure, const Links& links,
                            const std::vector<Color>& reflectance, const std::vector<Color>& radiosity, ErrorEstimation& errors) {
  const std::vector<double>& area = exposure.area;
  std::vector<std::array<glm::dvec3, 3>> gradient(hierarchy.size(), {glm::dvec3{0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}});
  const auto arrives = [&](std::uint32_t i, double exchange, const Color& sent, const glm::dvec3& slope) {
    for (std::size_t c = 0; c < 3; ++c) { gradient[i][c] += exchange / area[i] * sent[static_cast<int>(c)] * slope; }
  };
  for (const Link& link : links) {
    const double exchange = static_cast<double>(link.exchange);
    if (!(exchange > 0.0) || hierarchy[link.p].is_cluster() || hierarchy[link.q].is_cluster()) { continue; }
    arrives(link.p, exchange, radiosity[link.q], link.slope_p.vector());
    arrives(link.q, exchange, radiosity[link.p], link.slope_q.vector());
  }
  errors.leaves.assign(hierarchy.size(), 0.0f);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    const Node& node = hierarchy[i];
    if (node.is_cluster() || !(area[i] > 0.0)) { continue; }
    for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) {
      for (std::size_t c = 0; c < 3; ++c) { gradient[k][c] += gradient[i][c]; }
    }
    if (!node.leaf()) { continue; }
    double square = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double rho = reflectance[node.surface][static_cast<int>(c)];
      square += area[i] * rho * rho * mean_square(patches[i], gradient[i][c]);
    }
    errors.leaves[i] = static_cast<float>(square);
    errors.of_leaves += square;
  }
}

// The same where the slopes at leaves are not known: leaves of one parent differ as the light changes over the parent. Where it changes
// linearly, four halves of it, squares or triangles, vary a third as much each as they do among each other.
inline double leaf_errors_by_siblings(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<Color>& radiosity) {
  double sum = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    const Node& node = hierarchy[i];
    if (node.leaf() || node.is_cluster()) { continue; }
    double among = 0.0, leaves = 0.0;
    for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) {
      const Color off = radiosity[k] - radiosity[i];
      among += area[k] * glm::dot(off, off);
      leaves += hierarchy[k].leaf() ? area[k] : 0.0;
    }
    if (leaves > 0.0) { sum += among / 3.0 * leaves / area[i]; }
  }
  return sum;
}

// For links that were not made by BF-refinement: from at most 1024 links of lights and 3072 others, spread evenly; their shapes are
// found now.
inline ErrorEstimation sampled_estimate(const LinkEvaluator& evaluator, const Hierarchy& hierarchy, const Exposure& exposure,
                                        const Links& links, const std::vector<Color>& reflectance, const std::vector<Color>& emission,
                                        const std::vector<Color>& radiosity, unsigned threads) {
  const auto emits = [&](std::uint32_t i) { return !hierarchy[i].is_cluster() && !is_black(emission[hierarchy[i].surface]); };
  std::vector<std::uint32_t> of_lights, others;
  for (std::uint32_t i = 0; i < links.size(); ++i) { (emits(links[i].p) || emits(links[i].q) ? of_lights : others).push_back(i); }
  ErrorEstimation result;
  result.of_leaves = leaf_errors_by_siblings(hierarchy, exposure.area, radiosity);
  const auto add = [&](const std::vector<std::uint32_t>& from, std::size_t most) {
    const std::size_t count = std::min(from.size(), most);
    if (count == 0) { return; }
    Links sample(count);
    std::vector<LinkShape> shapes(count);
    parallel_for(count, threads, [&](std::size_t i) {
      sample[i] = links[from[i * from.size() / count]];
      const float closed = sample[i].exchange;
      (void)evaluator(sample[i], {}, &shapes[i]);
      sample[i].exchange = closed;
    });
    const double each = static_cast<double>(from.size()) / static_cast<double>(count);
    const ErrorEstimation of_sample = estimate_link_errors(hierarchy, exposure, sample, shapes, reflectance, emission, radiosity);
    result.of_links += each * of_sample.of_links;
    result.norm = of_sample.norm;
    // Leaves without siblings: their links for themselves.
    const auto alone = [&](std::uint32_t i, std::uint32_t from_node, double exchange, float linear) {
      if (!hierarchy[i].leaf() || !is_input_face(hierarchy, i)) { return; }
      const Color light = exchange / exposure.area[i] * static_cast<double>(linear) * reflectance[hierarchy[i].surface] * radiosity[from_node];
      result.of_leaves += each * exposure.area[i] * glm::dot(light, light);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const double exchange = static_cast<double>(sample[i].exchange);
      alone(sample[i].p, sample[i].q, exchange, shapes[i].p.linear);
      alone(sample[i].q, sample[i].p, exchange, shapes[i].q.linear);
    }
  };
  add(of_lights, 1024);
  add(others, 3072);
  return result;
}

}  // namespace detail

}  // namespace radiosity
