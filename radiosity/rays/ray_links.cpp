// SPDX-License-Identifier: MIT
#include <radiosity/rays/ray_links.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/rays/senders.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/support/big_array.hpp>

namespace radiosity {

namespace detail {

// Which two nodes a ray is counted for. The rest is computed when its link is made: rays are many, and all of these exist at once.
struct RayPart {
  std::uint32_t p = no_node, q = no_node;  // p < q
  std::uint32_t caster = no_node;          // the node from which it starts
  std::uint32_t code = 0;                  // twice its number among those of the caster, plus 1 if it starts on q and ends on p
  [[nodiscard]] std::uint32_t ray() const { return code >> 1; }
  [[nodiscard]] bool starts_on_q() const { return (code & 1u) != 0; }
};

// What a ray contributes to the link of its two nodes.
struct RaySample {
  double exchange = 0.0;
  glm::vec3 at_p{0.0f}, at_q{0.0f};  // end points, relative to the nodes' centroids
};

// Finds the nodes for which rays are counted.
class Pooling {
 public:
  Pooling(const DiscreteScene& scene, const StoredRays& rays) : hierarchy_{&scene.hierarchy}, nearness_(scene.hierarchy.size(), 0.0) {
    const Hierarchy& hierarchy = *hierarchy_;
    std::vector<double> area(hierarchy.size(), 0.0);  // of the casting nodes below
    for (std::size_t i = hierarchy.size(); i-- > 0;) {
      if (rays.count(i) > 0) {
        area[i] = scene.exposure.area[i];
        const double near = rays.nearness(i, 0.1 * hierarchy[i].radius);
        nearness_[i] = area[i] * near * near;
      }
      if (hierarchy[i].parent != no_node) {
        area[hierarchy[i].parent] += area[i];
        nearness_[hierarchy[i].parent] += nearness_[i];
      }
      if (area[i] > 0.0) { nearness_[i] = std::sqrt(nearness_[i] / area[i]); }
    }
  }

  [[nodiscard]] std::uint32_t node(std::uint32_t caster, double length) const {
    const Hierarchy& hierarchy = *hierarchy_;
    std::uint32_t i = caster;
    for (std::uint32_t up = hierarchy[i].parent; up != no_node && !hierarchy[up].is_cluster(); up = hierarchy[i].parent) {
      if (hierarchy[up].radius > most_pooled * length || hierarchy[up].radius * nearness_[up] > most_pooled) { break; }
      i = up;
    }
    return i;
  }

 private:
  const Hierarchy* hierarchy_;
  // By node: 1 / distance of what it sees. The RMS over its area, so that a roof over a part of a plain counts, however large the plain.
  std::vector<double> nearness_;
};

// The parts of all rays between nodes that cast.
[[nodiscard]] HALFLIGHT_INLINE BigArray<RayPart> parts_of(const DiscreteScene& scene, const StoredRays& rays, RayLinks& result) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const Pooling pooling{scene, rays};
  BigArray<RayPart> parts(scene.budget.arrays);
  parts.reserve(rays.size());
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    std::size_t carried = 0;
    for (const StoredRay& ray : rays.of(i)) {
      const std::uint32_t to = ray.to == no_node ? no_node : result.caster[ray.to];
      if (to == no_node || !(result.density[to] > 0.0)) { continue; }
      ++carried;
      if (to == i) { continue; }  // a hollow patch that sees itself: its rays to others represent this light, too
      const auto length = static_cast<double>(ray.length);
      std::uint32_t p = pooling.node(i, length);
      std::uint32_t q = pooling.node(to, length);
      if (p == q) {  // a hollow patch that sees itself: use its casting nodes
        p = i;
        q = to;
      }
      const auto exchange = static_cast<float>(1.0 / (result.density[i] + result.density[to]));
      if (!(exchange > 0.0f)) { continue; }  // too small for a float
      const auto code = 2 * static_cast<std::uint32_t>(&ray - rays.of(i).data());
      parts.push_back(p < q ? RayPart{p, q, i, code} : RayPart{q, p, i, code + 1});
    }
    if (rays.count(i) > 0) { result.share[i] = static_cast<double>(carried) / static_cast<double>(rays.count(i)); }
  }
  return parts;
}

// By node: the number of rays that start on it, per exposed area.
[[nodiscard]] HALFLIGHT_INLINE std::vector<double> densities(const DiscreteScene& scene, const StoredRays& rays) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  std::vector<double> density(hierarchy.size(), 0.0);
  for (std::size_t i = hierarchy.size(); i-- > 0;) {  // children before parents
    density[i] += static_cast<double>(rays.count(i));
    if (hierarchy[i].parent != no_node) { density[hierarchy[i].parent] += density[i]; }
  }
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { density[i] = area[i] > 0.0 ? density[i] / area[i] : 0.0; }
  return density;
}

[[nodiscard]] HALFLIGHT_INLINE RaySample sample_of(const DiscreteScene& scene, const StoredRays& rays, const RayLinks& result,
                                                   const RayPart& part) {
  const StoredRay& ray = rays.of(part.caster)[part.ray()];
  const std::uint32_t start = part.starts_on_q() ? part.q : part.p, end = part.starts_on_q() ? part.p : part.q;
  const auto exchange = static_cast<float>(1.0 / (result.density[part.caster] + result.density[result.caster[ray.to]]));
  const glm::vec3 at_start{glm::dvec3{ray.start} + scene.hierarchy[part.caster].centre - scene.exposure.centroid[start]};
  const glm::vec3 at_end{glm::dvec3{ray.end} + scene.hierarchy[ray.to].centre - scene.exposure.centroid[end]};
  return {static_cast<double>(exchange), part.starts_on_q() ? at_end : at_start, part.starts_on_q() ? at_start : at_end};
}

// The link of parts that all belong to the same pair.
[[nodiscard]] HALFLIGHT_INLINE Link pooled_link(const DiscreteScene& scene, const StoredRays& rays, const RayLinks& result,
                                                const BigArray<RayPart>& parts, std::span<const std::uint32_t> of) {
  const std::uint32_t p = parts[of.front()].p;
  const std::uint32_t q = parts[of.front()].q;
  double sum = 0.0;
  glm::dvec3 moment_p{0.0};
  glm::dvec3 moment_q{0.0};
  for (const std::uint32_t k : of) {
    const RaySample sample = sample_of(scene, rays, result, parts[k]);
    sum += sample.exchange;
    moment_p += sample.exchange * glm::dvec3{sample.at_p};
    moment_q += sample.exchange * glm::dvec3{sample.at_q};
  }
  Link link{p, q, static_cast<float>(sum), {}, {}};
  // No gradient within a casting node, which has too few rays for one.
  const auto gradient = [&](std::uint32_t i, const glm::dvec3& moment) {
    return result.caster[i] == no_node ? EndShape::of_patch(glm::vec3{scene.patches[i].inverse_inertia * (moment / sum)}) : EndShape{};
  };
  link.shape_p = gradient(p, moment_p);
  link.shape_q = gradient(q, moment_q);
  return link;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<std::uint32_t> ray_counts(const DiscreteScene& scene, const std::vector<Caster>& casters, double mean) {
  const std::vector<double>& area = scene.exposure.area;
  double all = 0.0;
  double weighted = 0.0;
  for (const Caster& caster : casters) {
    all += area[caster.node];
    weighted += caster.weight * std::sqrt(area[caster.node]);
  }
  // Fewer say too little about what is near a node. A picture gathers its light anew, so for that a quarter suffices where nodes are so
  // many that this least number, not the light, would decide about the time.
  constexpr double least_each = 32.0, most_by_least = 0x1p20;
  const double of_many = std::clamp(most_by_least / static_cast<double>(casters.size()), 0.25 * least_each, least_each);
  const double least = scene.control.viewpoint ? of_many : least_each;
  // Some weights are hundreds of times larger than others, so the total is limited. With a camera, slivers in view have them: the limit is
  // the number that equal weights would give, or, beyond `few`, the geometric mean of both, because a picture averages over what its points
  // see, the more the more nodes. Without a camera, casters close to others have them, which all are where things touch everywhere: the
  // limit is four times the number by equal weights.
  constexpr double few = 0x1p22, times_even = 4.0;
  const double wished = mean * weighted * weighted / all, even = mean * static_cast<double>(casters.size());
  const double most = std::max(few, scene.control.viewpoint ? std::sqrt(few * even) : times_even * even);
  if (wished > most) { mean *= most / wished; }
  std::vector<std::uint32_t> counts(scene.hierarchy.size(), 0);
  for (const Caster& caster : casters) {
    if (!(area[caster.node] > 0.0)) { continue; }
    const double wanted = mean * caster.weight * std::sqrt(area[caster.node]) * weighted / all;
    counts[caster.node] = static_cast<std::uint32_t>(std::clamp(std::round(wanted), least, 1e6));
  }
  return counts;
}

HALFLIGHT_INLINE double rays_per_node(double epsilon) { return std::clamp(12.8 / std::sqrt(epsilon), 16.0, 65536.0); }

HALFLIGHT_INLINE RayLinks make_ray_links(const DiscreteScene& scene, const StoredRays& rays, const std::vector<Caster>& casters) {
  const Hierarchy& hierarchy = scene.hierarchy;
  RayLinks result;
  result.links = Links(scene.budget.arrays);
  result.rays = rays.size();
  result.share.assign(hierarchy.size(), 0.0);
  result.density = detail::densities(scene, rays);
  result.caster.assign(hierarchy.size(), no_node);
  for (const Caster& caster : casters) { result.caster[caster.node] = caster.node; }
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {  // parents before children
    if (result.caster[i] == no_node && hierarchy[i].parent != no_node) { result.caster[i] = result.caster[hierarchy[i].parent]; }
  }
  const BigArray<detail::RayPart> parts = detail::parts_of(scene, rays, result);
  // Sort the parts by p, then by q.
  std::vector<std::size_t> first(hierarchy.size() + 1, 0);
  for (const detail::RayPart& part : parts) { ++first[part.p + 1]; }
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { first[i + 1] += first[i]; }
  BigArray<std::uint32_t> order(parts.size(), scene.budget.arrays);
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t k = 0; k < parts.size(); ++k) { order[next[parts[k].p]++] = k; }
  std::size_t links = 0;  // counted first: an array that grows exists twice for a while
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    const std::span<std::uint32_t> of_p = std::span(order).subspan(first[i], first[i + 1] - first[i]);
    std::sort(of_p.begin(), of_p.end(),
              [&](std::uint32_t a, std::uint32_t b) { return parts[a].q != parts[b].q ? parts[a].q < parts[b].q : a < b; });
    for (std::size_t k = 0; k < of_p.size(); ++k) { links += k == 0 || parts[of_p[k]].q != parts[of_p[k - 1]].q ? 1 : 0; }
  }
  result.links.reserve(links);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const detail::RayPart& part = parts[order[begin]];
    while (end < order.size() && parts[order[end]].p == part.p && parts[order[end]].q == part.q) { ++end; }
    result.links.push_back(
        detail::pooled_link(scene, rays, result, parts, std::span<const std::uint32_t>(order).subspan(begin, end - begin)));
  }
  return result;
}

}  // namespace radiosity
