// SPDX-License-Identifier: MIT
// What the rays tell of the links made from them: the row sums, and the noise.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/inline.hpp>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/rays/ray_links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

namespace detail {

// By node: the variance of the row sum by the links of the node and its ancestors, if each ray is an independent event (Poisson).
[[nodiscard]] HALFLIGHT_INLINE std::vector<double> row_variances(const DiscreteScene& scene, const Links& made,
                                                                 const std::vector<double>& density) {
  const std::vector<double>& area = scene.exposure.area;
  std::vector<double> variance(scene.hierarchy.size(), 0.0);
  for (const Link& link : made) {
    const double square = static_cast<double>(link.exchange) / (density[link.p] + density[link.q]);
    variance[link.p] += square / (area[link.p] * area[link.p]);
    variance[link.q] += square / (area[link.q] * area[link.q]);
  }
  for (std::size_t i = 0; i < variance.size(); ++i) {  // parents before children
    if (scene.hierarchy[i].parent != no_node) { variance[i] += variance[scene.hierarchy[i].parent]; }
  }
  return variance;
}

// A number that independent estimates make more precise.
struct RowEstimate {
  double value = 0.0, variance = 0.0;

  void improve(double other, double variance_of_other) {
    if (!(variance > 0.0)) { return; }
    const double trust = variance / (variance + variance_of_other);
    value += trust * (other - value);
    variance *= 1.0 - trust;
  }
};

}  // namespace detail

HALFLIGHT_INLINE std::vector<double> RayLinks::row_sums(const DiscreteScene& scene, const Transport& transport, const Links& made,
                                                        const std::vector<double>& computed, const std::vector<double>& of_lamps,
                                                        double error_of_lamps) const {
  const std::vector<double>& area = scene.exposure.area;
  const auto left = [&](std::size_t i) {
    return transport.closed(i) ? std::max(least_left, 1.0 - of_lamps[i]) : computed[i] * std::max(0.0, 1.0 - of_lamps[i]);
  };
  struct Means {
    double computed = 0.0, of_lamps = 0.0, left = 0.0;
  };
  std::vector<Means> means(computed.size());  // over the leaves of each casting node
  double all = 0.0, square = 0.0;
  for (std::size_t i = 0; i < computed.size(); ++i) {
    if (!scene.hierarchy[i].leaf()) { continue; }
    all += area[i];
    square += area[i] * of_lamps[i] * of_lamps[i];
    if (caster[i] == no_node || !(area[caster[i]] > 0.0)) { continue; }
    const double part = area[i] / area[caster[i]];
    Means& mean = means[caster[i]];
    mean.computed += part * computed[i];
    mean.of_lamps += part * of_lamps[i];
    mean.left += part * left(i);
  }
  const double relative = square > 0.0 ? error_of_lamps * std::sqrt(all / square) : 0.0;
  const std::vector<double> variance = detail::row_variances(scene, made, density);
  std::vector<double> rows(computed.size(), 0.0);
  for (std::size_t i = 0; i < computed.size(); ++i) {
    const std::uint32_t c = caster[i];
    if (!scene.hierarchy[i].leaf() || c == no_node || !(means[c].left > 0.0)) { continue; }
    detail::RowEstimate row{means[c].computed, variance[c]};
    row.improve(share[c], visibility_variance(share[c], density[c] * area[c]));
    const double off = relative * means[c].of_lamps;
    if (transport.closed(i)) { row.improve(1.0 - means[c].of_lamps, off * off); }
    rows[i] = left(i) * std::max(0.0, row.value) / means[c].left;
  }
  return rows;
}

HALFLIGHT_INLINE double RayLinks::noise(const DiscreteScene& scene, const Links& made, const std::vector<Color>& radiosity) const {
  const std::vector<double>& area = scene.exposure.area;
  struct Arrived {
    double exchange = 0.0;
    Color light{0.0};
  };
  std::vector<Arrived> arrived(scene.hierarchy.size());
  const auto each_end = [&](const auto& visit) {
    for (const Link& link : made) {
      const auto exchange = static_cast<double>(link.exchange);
      visit(link.p, link.q, exchange);
      visit(link.q, link.p, exchange);
    }
  };
  each_end([&](std::uint32_t to, std::uint32_t from, double exchange) {
    arrived[to].exchange += exchange;
    arrived[to].light += exchange * radiosity[from];
  });
  double square = 0.0;
  each_end([&](std::uint32_t to, std::uint32_t from, double exchange) {
    const double variance = exchange / (density[to] + density[from]);
    const Color off = scene.reflectance[scene.hierarchy[to].surface] * (radiosity[from] - arrived[to].light / arrived[to].exchange);
    square += variance / area[to] * glm::dot(off, off);
  });
  return square;
}

}  // namespace radiosity
