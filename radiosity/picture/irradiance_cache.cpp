// SPDX-License-Identifier: MIT
#include <radiosity/picture/irradiance_cache.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

// Hash of the cell that contains the point, in a grid with this cell width. Cells with equal hashes share a list, which costs only time.
[[nodiscard]] HALFLIGHT_INLINE std::uint64_t cell_key(int grid, const glm::dvec3& point, double width) {
  std::uint64_t key = static_cast<std::uint64_t>(grid);
  for (int k = 0; k < 3; ++k) { key = scramble(key ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(point[k] / width)))); }
  return key;
}

}  // namespace detail

template <class Visit>
void IrradianceCache::each_near(const glm::dvec3& position, const Visit& visit) const {
  for (const int grid : grids_) {
    const auto found = cells_.find(detail::cell_key(grid, position, std::ldexp(1.0, grid)));
    if (found == cells_.end()) { continue; }
    for (const std::uint32_t i : found->second) { visit(i); }
  }
}

HALFLIGHT_INLINE void IrradianceCache::add(const GatheredPoint& point) {
  const auto index = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  // Cells of two to four radii, so that a sphere overlaps at most two cells in each direction.
  const int grid = std::ilogb(point.widest) + 2;
  const double width = std::ldexp(1.0, grid);
  if (const auto at = std::lower_bound(grids_.begin(), grids_.end(), grid); at == grids_.end() || *at != grid) { grids_.insert(at, grid); }
  std::vector<std::uint64_t> keys;
  for (unsigned k = 0; k < 8; ++k) {
    const glm::dvec3 corner{k & 1 ? point.widest : -point.widest, k & 2 ? point.widest : -point.widest,
                            k & 4 ? point.widest : -point.widest};
    keys.push_back(detail::cell_key(grid, point.position + corner, width));
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const std::uint64_t key : keys) { cells_[key].push_back(index); }
}

HALFLIGHT_INLINE bool IrradianceCache::covered(const FinalGather::Place& place) const {
  bool result = false;
  each_near(place.point.position,
            [&](std::uint32_t i) { result = result || points_[i].covers(place.point.position, place.point.normal, place.object); });
  return result;
}

HALFLIGHT_INLINE GatheredPoint IrradianceCache::gather(const Wanted& wanted) const {
  const FinalGather::Place& place = wanted.place;
  const glm::dvec3& p = place.point.position;
  std::uint64_t key = place.surface;
  for (int k = 0; k < 3; ++k) { key = scramble(key ^ std::bit_cast<std::uint64_t>(p[k])); }
  const auto found = light_->indirect(place, gather_rays, key);
  GatheredPoint point;
  point.position = p;
  point.normal = place.point.normal;
  point.object = place.object;
  point.radius = std::clamp(sphere_radius(found.nearness, found.nearest), wanted.least_radius, wanted.most_radius);
  point.widest = most_fit * point.radius;
  point.gathered = found.irradiance;
  point.variance = found.variance;
  return point;
}

HALFLIGHT_INLINE bool IrradianceCache::extend(std::span<const Wanted> wanted, const Control& control) {
  if (wanted.empty()) { return true; }
  // Consecutive places are near each other, so they are visited at decreasing strides.
  std::vector<std::uint32_t> order, chosen;
  for (std::size_t stride = std::bit_floor(wanted.size()); stride > 0; stride /= 2) {
    for (std::size_t i = 0; i < wanted.size(); i += stride) {
      if (stride == std::bit_floor(wanted.size()) || i / stride % 2 == 1) { order.push_back(static_cast<std::uint32_t>(i)); }
    }
  }
  constexpr std::size_t batch = 256;  // points that are gathered in parallel, without knowing of each other
  std::vector<char> open(4 * batch);
  std::vector<GatheredPoint> found;
  const std::size_t before = points_.size();
  for (std::size_t first = 0; first < order.size();) {
    if (control.cancelled()) { return false; }
    const std::size_t count = std::min(order.size() - first, 4 * batch);
    parallel_for(
        count, threads_, [&](std::size_t k) { open[k] = !covered(wanted[order[first + k]].place); }, 64);
    chosen.clear();
    std::size_t looked_at = 0;
    for (; looked_at < count && chosen.size() < batch; ++looked_at) {
      if (open[looked_at]) { chosen.push_back(order[first + looked_at]); }
    }
    first += looked_at;
    found.resize(chosen.size());
    const auto gather_one = [&](std::size_t k) { found[k] = gather(wanted[chosen[k]]); };
    if (!parallel_in_batches(control, threads_, chosen.size(), {batch, 4}, gather_one)) { return false; }
    for (const GatheredPoint& point : found) { add(point); }
    control.report("mesh", static_cast<double>(first) / static_cast<double>(order.size()));
  }
  if (points_.size() > before) { fit_all(); }
  return true;
}

HALFLIGHT_INLINE void IrradianceCache::fit_all() {
  std::vector<std::vector<const GatheredPoint*>> around(points_.size());
  for (const GatheredPoint& point : points_) {
    each_near(point.position, [&](std::uint32_t i) {
      const GatheredPoint& sphere = points_[i];
      if (sphere.weight(point.position, point.normal, point.object, sphere.widest) > 0.0) { around[i].push_back(&point); }
    });
  }
  parallel_for(
      points_.size(), threads_, [&](std::size_t i) { fit(points_[i], around[i]); }, 16);
}

HALFLIGHT_INLINE std::optional<Color> IrradianceCache::at(const FinalGather::Place& place) const {
  Color sum{0.0};
  double weights = 0.0;
  each_near(place.point.position, [&](std::uint32_t i) {
    const double own = points_[i].weight(place.point.position, place.point.normal, place.object);
    if (!(own > 0.0)) { return; }
    sum += own * points_[i].at(place.point.position);
    weights += own;
  });
  if (!(weights > 0.0)) { return std::nullopt; }
  return glm::max(sum / weights, Color{0.0});
}

}  // namespace radiosity
