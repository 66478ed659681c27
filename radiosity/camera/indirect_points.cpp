// SPDX-License-Identifier: MIT
#include <radiosity/camera/indirect_points.hpp>

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <brep/inline.hpp>

namespace radiosity {

namespace detail {

// Limits of the radius of a point's sphere, found by measurement. The lower one counts pixels as wide as they are across, the others as
// long as a slanted surface makes them: along the slant light may change as fast as across it, and a sphere that reached further than
// the gather allowed would carry the dark of a gap to open ceiling, or the light of a window to the wall beside it. The fit may reach
// further, because it takes the points of so wide a sphere only if a plane explains them.
inline constexpr double least_pixels = 1.0, most_pixels = 20.0, least_pixels_of_fit = 6.0;

HALFLIGHT_INLINE void set_radius(IndirectPoint& point, double radius, double pixel_size) {
  point.radius = radius;
  point.widest = std::max(most_fit * radius, point.least_widest);
  point.pixels = point.radius / pixel_size;
  point.widest_pixels = point.widest / pixel_size;
}

}  // namespace detail

HALFLIGHT_INLINE IndirectPoint indirect_point(const FinalGather::Indirect& found, const std::array<std::uint32_t, 2>& pixel,
                                              const FinalGather::Place& place, const glm::dvec3& eye, double pixel_size) {
  IndirectPoint point;
  point.position = place.point.position;
  point.normal = place.point.normal;
  point.object = place.object;
  point.x = pixel[0];
  point.y = pixel[1];
  const double facing = std::abs(glm::dot(point.normal, glm::normalize(point.position - eye)));
  // Width of a pixel on the surface; limited to five times the unslanted width.
  const double footprint = pixel_size / std::max(facing, 0.2);
  const double allowed = sphere_radius(std::max(found.nearness, found.nearness_of_light), found.nearest);
  point.least_widest = detail::least_pixels_of_fit * footprint;
  detail::set_radius(point, std::clamp(allowed, detail::least_pixels * pixel_size, detail::most_pixels * footprint), pixel_size);
  point.gathered = found.irradiance;
  point.variance = found.variance;
  return point;
}

HALFLIGHT_INLINE void limit_radius(IndirectPoint& point, double most) {
  if (!(most < point.radius)) { return; }
  const double pixel_size = point.radius / point.pixels;
  detail::set_radius(point, std::max(most, detail::least_pixels * pixel_size), pixel_size);
}

HALFLIGHT_INLINE IndirectPoints::IndirectPoints(std::uint32_t width, std::uint32_t height)
    : columns_{(width + tile - 1) / tile},
      rows_{(height + tile - 1) / tile},
      tiles_(std::size_t{columns_} * rows_),
      in_tiles_(std::size_t{columns_} * rows_) {}

template <class Visit>
void IndirectPoints::each_tile(const IndirectPoint& point, double pixels, const Visit& visit) const {
  const auto reach = static_cast<std::int64_t>(std::ceil(pixels));
  const auto column = [&](std::int64_t x) { return std::clamp<std::int64_t>(x / tile, 0, columns_ - 1); };
  const auto row = [&](std::int64_t y) { return std::clamp<std::int64_t>(y / tile, 0, rows_ - 1); };
  const std::int64_t x = point.x, y = point.y;
  for (std::int64_t v = row(std::max<std::int64_t>(0, y - reach)); v <= row(y + reach); ++v) {
    for (std::int64_t u = column(std::max<std::int64_t>(0, x - reach)); u <= column(x + reach); ++u) {
      visit(static_cast<std::size_t>(v * columns_ + u));
    }
  }
}

HALFLIGHT_INLINE void IndirectPoints::add(const IndirectPoint& point) {
  const auto index = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  each_tile(point, point.pixels, [&](std::size_t t) {
    tiles_[t].push_back(index);
    ++in_lists_;
  });
  in_tiles_[std::size_t{point.y / tile} * columns_ + point.x / tile].push_back(index);
  ++in_lists_;
}

HALFLIGHT_INLINE bool IndirectPoints::covered(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                                              std::uint32_t object) const {
  for (const std::uint32_t i : near(x, y)) {
    if (points_[i].covers(position, normal, object)) { return true; }
  }
  return false;
}

HALFLIGHT_INLINE std::vector<const GatheredPoint*> IndirectPoints::around(const IndirectPoint& point) const {
  std::vector<const GatheredPoint*> result;
  each_tile(point, point.widest_pixels, [&](std::size_t t) {
    for (const std::uint32_t k : in_tiles_[t]) {
      if (point.weight(points_[k].position, points_[k].normal, points_[k].object, point.widest) > 0.0) { result.push_back(&points_[k]); }
    }
  });
  return result;
}

HALFLIGHT_INLINE void IndirectPoints::fit(std::size_t i) { radiosity::fit(points_[i], around(points_[i])); }

HALFLIGHT_INLINE std::optional<Color> IndirectPoints::at(std::uint32_t x, std::uint32_t y, const glm::dvec3& position,
                                                         const glm::dvec3& normal, std::uint32_t object) const {
  Color sum{0.0};
  double weights = 0.0;
  for (const std::uint32_t i : near(x, y)) {
    const double own = points_[i].weight(position, normal, object);
    if (!(own > 0.0)) { continue; }
    sum += own * points_[i].at(position);
    weights += own;
  }
  if (!(weights > 0.0)) { return std::nullopt; }
  return glm::max(sum / weights, Color{0.0});
}

}  // namespace radiosity
