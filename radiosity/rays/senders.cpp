// SPDX-License-Identifier: MIT
#include <radiosity/rays/senders.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/refinement/discrete_scene.hpp>

namespace radiosity {

namespace detail {

// By node: the standard deviation of the brightness over its exposed leaves.
[[nodiscard]] HALFLIGHT_INLINE std::vector<double> deviations(const DiscreteScene& scene, const std::vector<double>& brightness) {
  const Hierarchy& hierarchy = scene.hierarchy;
  struct Moments {
    double area = 0.0, first = 0.0, second = 0.0;  // integrals of 1, of the brightness, and of its square
  };
  std::vector<Moments> moments(hierarchy.size());
  std::vector<double> deviation(hierarchy.size(), 0.0);
  for (std::size_t i = hierarchy.size(); i-- > 0;) {  // children before parents
    Moments& own = moments[i];
    if (hierarchy[i].leaf()) {
      const double area = scene.exposure.area[i];
      own = {area, area * brightness[i], area * brightness[i] * brightness[i]};
    } else if (own.area > 0.0) {
      const double mean = own.first / own.area;
      deviation[i] = std::sqrt(std::max(0.0, own.second / own.area - mean * mean));
    }
    if (hierarchy[i].parent == no_node) { continue; }
    Moments& parent = moments[hierarchy[i].parent];
    parent = {parent.area + own.area, parent.first + own.first, parent.second + own.second};
  }
  return deviation;
}

// By node: the caster at or above it, or no_node.
[[nodiscard]] HALFLIGHT_INLINE std::vector<std::uint32_t> casters_above(const Hierarchy& hierarchy, const std::vector<Caster>& casters) {
  std::vector<std::uint32_t> above(hierarchy.size(), no_node);
  for (const Caster& caster : casters) { above[caster.node] = caster.node; }
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {  // parents before children
    if (above[i] == no_node && hierarchy[i].parent != no_node) { above[i] = above[hierarchy[i].parent]; }
  }
  return above;
}

// By caster: the squared L2 error of what the views receive from it at a short distance, relative to the total area. Each view is assumed
// to see light that differs from the mean by one standard deviation.
[[nodiscard]] HALFLIGHT_INLINE std::vector<double> errors_sent(const Hierarchy& hierarchy, const std::vector<std::uint32_t>& caster,
                                                               const std::vector<CasterView>& views, const std::vector<double>& deviation) {
  std::vector<double> squares(hierarchy.size(), 0.0);
  for (const CasterView& view : views) {
    std::array<std::uint32_t, std::tuple_size_v<decltype(CasterView::rays)>> near{};
    std::size_t count = 0;
    for (const CasterView::Seen& seen : view.rays) {
      const std::uint32_t sender = seen.leaf != no_node ? caster[seen.leaf] : no_node;
      if (sender == no_node || !(hierarchy[sender].radius > most_pooled * static_cast<double>(seen.distance))) { continue; }
      near[count++] = sender;
    }
    std::sort(near.begin(), near.begin() + count);
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
      while (end < count && near[end] == near[begin]) { ++end; }
      const double share = static_cast<double>(end - begin) / static_cast<double>(near.size());
      const double error = view.reflectance * share * deviation[near[begin]];
      squares[near[begin]] += view.area * error * error;
    }
  }
  return squares;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<Caster> split_senders(const DiscreteScene& scene, std::vector<Caster> casters,
                                                   const std::vector<CasterView>& views, const std::vector<double>& brightness,
                                                   double tolerance) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double> deviation = detail::deviations(scene, brightness);
  for (std::size_t before = 0; before != casters.size();) {
    before = casters.size();
    const std::vector<double> squares = detail::errors_sent(hierarchy, detail::casters_above(hierarchy, casters), views, deviation);
    std::vector<Caster> next;
    for (const Caster& caster : casters) {
      const Node& node = hierarchy[caster.node];
      if (node.leaf() || !(squares[caster.node] > tolerance * tolerance)) {
        next.push_back(caster);
        continue;
      }
      for (std::uint32_t k = 0; k < node.child_count; ++k) { next.push_back({node.first_child + k, caster.weight}); }
    }
    casters = std::move(next);
  }
  return casters;
}

}  // namespace radiosity
