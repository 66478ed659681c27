// SPDX-License-Identifier: MIT
#include <radiosity/clusters/cluster_exchange.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/scene.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/segment_samples.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

HALFLIGHT_INLINE ClusterEnd ClusterSampler::end(std::uint32_t node, const glm::dvec3& direction) const {
  const Node& n = scene_.hierarchy[node];
  if (!n.is_cluster()) { return {node, {}, area(node)}; }
  const Aim towards = aim(direction);
  return {node, towards, shown_->of(n, towards)};
}

HALFLIGHT_INLINE ClusterExchange ClusterSampler::operator()(const ClusterEnd& p, const ClusterEnd& q, std::uint32_t rounds,
                                                            Random random) const {
  ClusterExchange result;
  if (!(p.shown > 0.0) || !(q.shown > 0.0)) { return result; }
  double all = 0.0;
  double arrived = 0.0;
  double square = 0.0;
  double n = 0.0;
  std::uint32_t blocked = 0;
  std::uint32_t hint = raycast::no_shape;
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const auto shift = static_cast<std::uint32_t>(random.bits() & 15u);
    raycast::Segments16 segments;
    std::array<double, 16> weights{};
    for (std::uint32_t i = 0; i < 16; ++i) {
      const Point x = draw(p, (i + random.uniform()) / 16.0, random);
      const Point y = draw(q, (detail::opposite_cell(i, shift) + random.uniform()) / 16.0, random);
      const glm::dvec3 d = y.position - x.position;
      const double r2 = glm::dot(d, d);
      const double leaves = glm::dot(x.normal, d);
      const double arrives = -glm::dot(y.normal, d);
      const double edge_on = 1e-12 * std::sqrt(r2);  // below this, both points lie in one plane up to rounding
      if (!(leaves > edge_on && arrives > edge_on)) { continue; }
      weights[i] = std::min(leaves * arrives / r2 * x.per_shown * y.per_shown, most_weight) / (std::numbers::pi * r2);
      segments.set(i, {x.position, d}, x.object, y.object, x.sheet, y.sheet);
    }
    const std::uint32_t occluded = scene_.objects.occluded16(segments, hint);
    for (std::uint32_t i = 0; i < 16; ++i) {
      if (!(weights[i] > 0.0)) { continue; }
      ++result.rays;
      all += weights[i];
      if ((occluded >> i & 1u) != 0) {
        ++blocked;
        continue;
      }
      arrived += weights[i];
      square += weights[i] * weights[i];
    }
    n += 16.0;
    const double variance = square * n - arrived * arrived;  // relative to the squared sum
    if (blocked == 0 ? variance < 0.25 * arrived * arrived : blocked == result.rays && blocked >= 8) { break; }
  }
  const double mean = arrived / n;
  result.exchange = p.shown * q.shown * mean;
  result.fraction = all > 0.0 ? arrived / all : 1.0;
  result.spread = mean > 0.0 ? std::sqrt(std::max(0.0, square / n - mean * mean)) / mean : 0.0;
  return result;
}

HALFLIGHT_INLINE ClusterSampler::Point ClusterSampler::draw(const ClusterEnd& end, double u, Random& random) const {
  const Hierarchy& nodes = scene_.hierarchy;
  std::uint32_t i = end.node;
  double per_shown = 1.0;
  double rest = u * end.shown;
  while (nodes[i].is_cluster()) {
    const std::uint32_t last = nodes[i].first_child + nodes[i].child_count - 1;
    std::uint32_t chosen = no_node;  // the last child that shows any area, unless the sum reaches u before
    double of_chosen = 0.0;
    for (std::uint32_t c = nodes[i].first_child; c <= last; ++c) {
      const double facing = nodes[c].is_cluster() ? 0.0 : shown(nodes[c].normal, end.towards);
      const double part = nodes[c].is_cluster() ? shown_->of(nodes[c], end.towards) : area(c) * facing;
      if (!(part > 0.0)) { continue; }
      if (chosen != no_node) { rest -= of_chosen; }
      chosen = c;
      of_chosen = part;
      per_shown = facing;
      if (rest < part) { break; }
    }
    if (chosen == no_node) { return {}; }  // only by rounding
    i = chosen;
  }
  const PatchEnd ground = patch_end(scene_, exposure_, i);
  const auto cell = static_cast<std::uint32_t>(random.bits() & 15u);
  return {draw_exposed(ground, cell, random), ground.patch->normal, i == end.node ? 1.0 : 1.0 / per_shown, ground.object, ground.sheet};
}

HALFLIGHT_INLINE ClusterExchange evaluate_cluster_link(const ClusterSampler& sampler, const Hierarchy& hierarchy, Link& link,
                                                       std::uint32_t rounds, Random random) {
  link.exchange = 0.0f;
  const glm::dvec3 apart = hierarchy[link.q].centre - hierarchy[link.p].centre;
  if (!(glm::length(apart) > 0.0)) { return {}; }  // the two clusters are concentric, as a cluster and itself; no part sees another
  const glm::dvec3 d = glm::normalize(apart);
  const glm::dvec3 to_q = EndShape::stored_direction(d);
  const glm::dvec3 to_p = EndShape::stored_direction(-d);
  const ClusterEnd p = sampler.end(link.p, to_q);
  const ClusterEnd q = sampler.end(link.q, to_p);
  const ClusterExchange result = sampler(p, q, rounds, random);
  link.exchange = static_cast<float>(result.exchange);
  if (!(link.exchange > 0.0f)) { return result; }
  link.shape_p = hierarchy[link.p].is_cluster() ? EndShape::of_cluster(to_q, p.shown) : EndShape{};
  link.shape_q = hierarchy[link.q].is_cluster() ? EndShape::of_cluster(to_p, q.shown) : EndShape{};
  return result;
}

}  // namespace radiosity
