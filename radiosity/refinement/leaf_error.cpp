// SPDX-License-Identifier: MIT
#include <radiosity/refinement/leaf_error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE double mean_square(const Patch& patch, const glm::dvec3& g) {
  double sum = 0.0;
  for (const QuadraturePoint& x : patch.rule3) {
    const double change = glm::dot(g, x.position - patch.centroid);
    sum += x.weight * change * change;
  }
  return patch.area > 0.0 ? sum / patch.area : 0.0;
}

HALFLIGHT_INLINE LeafErrors estimate_leaf_errors(const DiscreteScene& scene, const Links& links, const std::vector<Color>& radiosity,
                                                 std::span<const double> each) {
  LeafErrors errors;
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  struct Gradient {
    std::array<glm::dvec3, 3> sum{glm::dvec3{0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}};  // of the irradiance, by channel
    Color squares{0.0};                                                                // sum of the links' squared gradients
    Color variance{0.0};                                                               // of `sum`, by the choice of the sample
  };
  std::vector<Gradient> gradient(hierarchy.size());
  const auto arrives = [&](std::uint32_t i, double exchange, const Color& sent, const glm::dvec3& relative, double times) {
    const Color light = exchange / area[i] * sent;
    for (std::size_t c = 0; c < 3; ++c) { gradient[i].sum[c] += times * light[static_cast<int>(c)] * relative; }
    const Color square = light * light * glm::dot(relative, relative);
    gradient[i].squares += times * square;
    gradient[i].variance += times * (times - 1.0) * square;
  };
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Link& link = links[k];
    const double times = each.empty() ? 1.0 : each[k];
    const double exchange = static_cast<double>(link.exchange);
    const bool p_cluster = hierarchy[link.p].is_cluster(), q_cluster = hierarchy[link.q].is_cluster();
    if ((p_cluster || q_cluster) && scene.clustered()) { continue; }  // of clusters only those of lamps have gradients at the other end
    if (!(exchange > 0.0) || !(p_cluster || area[link.p] > 0.0) || !(q_cluster || area[link.q] > 0.0)) { continue; }
    if (!p_cluster) { arrives(link.p, exchange, radiosity[link.q], link.shape_p.gradient(), times); }
    if (!q_cluster) { arrives(link.q, exchange, radiosity[link.p], link.shape_q.gradient(), times); }
  }
  errors.squares.assign(hierarchy.size(), 0.0f);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    const Node& node = hierarchy[i];
    if (node.is_cluster() || !(area[i] > 0.0)) { continue; }
    for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) {
      for (std::size_t c = 0; c < 3; ++c) { gradient[k].sum[c] += gradient[i].sum[c]; }
      gradient[k].squares += gradient[i].squares;
      gradient[k].variance += gradient[i].variance;
    }
    if (!node.leaf()) { continue; }
    double square = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec3& g = gradient[i].sum[c];
      const double rho = scene.reflectance[node.surface][static_cast<int>(c)];
      const double error = area[i] * rho * rho * mean_square(scene.patches[i], g), length2 = glm::dot(g, g);
      if (!(error > 0.0)) { continue; }
      square += error * (1.0 - gradient[i].variance[static_cast<int>(c)] / length2);
      errors.apart += error * gradient[i].squares[static_cast<int>(c)] / length2;
    }
    errors.squares[i] = static_cast<float>(square);
    errors.sum += square;
  }
  return errors;
}

// The leaf below `node` whose centre is nearest to x, found level by level.
[[nodiscard]] HALFLIGHT_INLINE std::uint32_t leaf_beside(const Hierarchy& hierarchy, const std::vector<double>& area, std::uint32_t node,
                                                         const glm::dvec3& x) {
  while (!hierarchy[node].leaf()) {
    const std::uint32_t first = hierarchy[node].first_child, end = first + hierarchy[node].child_count;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = first; k < end; ++k) {
      const double away = glm::length(hierarchy[k].centre - x);
      if (!(area[k] > 0.0) || !(away < least)) { continue; }
      least = away;
      node = k;
    }
    if (!std::isfinite(least)) { break; }
  }
  return node;
}

HALFLIGHT_INLINE double variation_by_siblings(const Hierarchy& hierarchy, const std::vector<double>& area,
                                              const std::vector<Color>& radiosity) {
  double sum = 0.0;
  const auto square_between = [&](std::uint32_t a, std::uint32_t b) {
    return glm::dot(radiosity[a] - radiosity[b], radiosity[a] - radiosity[b]);
  };
  // Squared difference between a leaf and a sibling that was split, extrapolated from the nearest of the sibling's leaves.
  const auto square_to = [&](std::uint32_t leaf, std::uint32_t child) {
    const glm::dvec3& x = hierarchy[leaf].centre;
    const std::uint32_t next = leaf_beside(hierarchy, area, child, x);
    const double away = glm::length(hierarchy[next].centre - x);
    const double longer = away > 0.0 ? glm::length(hierarchy[child].centre - x) / away : 1.0;
    return longer * longer * square_between(leaf, next);
  };
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    const Node& node = hierarchy[i];
    if (node.leaf() || node.is_cluster() || !(area[i] > 0.0)) { continue; }
    const std::uint32_t first = node.first_child, end = first + node.child_count;
    bool even = true;
    for (std::uint32_t k = first; k < end; ++k) { even = even && hierarchy[k].leaf(); }
    for (std::uint32_t k = first; k < end; ++k) {
      if (!hierarchy[k].leaf() || !(area[k] > 0.0)) { continue; }
      double least = std::numeric_limits<double>::infinity();
      for (std::uint32_t other = first; other < end; ++other) {
        if (other != k && area[other] > 0.0) { least = std::min(least, square_to(k, other)); }
      }
      if (even) {
        sum += area[k] * square_between(k, i) / 3.0;
      } else if (std::isfinite(least)) {
        sum += area[k] * least / 2.0;
      }
    }
  }
  return sum;
}

}  // namespace detail

}  // namespace radiosity
