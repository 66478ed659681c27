// SPDX-License-Identifier: MIT
#include "apps/indirect_points.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <radiosity/support/random.hpp>

namespace apps {
namespace {

constexpr double inner = 0.7;         // part of a ball's radius
constexpr double same_way = 0.9;      // cosine of two normals between which light is carried over
constexpr double out_of_plane = 0.2;  // of a ball's radius: what is farther off its tangent plane is another surface

// The weight of a point at some place: 0 where it says nothing.
double weight(const IndirectPoint& point, const glm::dvec3& position, const glm::dvec3& normal, std::uint32_t object) {
  if (point.object != object) { return 0.0; }
  const glm::dvec3 d = position - point.position;
  const double part = glm::dot(d, d) / (point.radius * point.radius);
  if (!(part < 1.0)) { return 0.0; }
  const double cosine = glm::dot(normal, point.normal);
  if (!(cosine > same_way) || std::abs(glm::dot(d, point.normal)) > out_of_plane * point.radius) { return 0.0; }
  const double turned = (cosine - same_way) / (1.0 - same_way);
  return (1.0 - part) * (1.0 - part) * turned;
}

}  // namespace

IndirectPoints::IndirectPoints(std::uint32_t width, std::uint32_t height)
    : columns_{(width + tile - 1) / tile}, rows_{(height + tile - 1) / tile}, tiles_(std::size_t{columns_} * rows_) {}

void IndirectPoints::add(const IndirectPoint& point) {
  const auto index = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  const auto reach = static_cast<std::int64_t>(std::ceil(point.pixels));
  const auto column = [&](std::int64_t x) { return std::clamp<std::int64_t>(x / tile, 0, columns_ - 1); };
  const auto row = [&](std::int64_t y) { return std::clamp<std::int64_t>(y / tile, 0, rows_ - 1); };
  const std::int64_t x = point.x, y = point.y;
  for (std::int64_t v = row(std::max<std::int64_t>(0, y - reach)); v <= row(y + reach); ++v) {
    for (std::int64_t u = column(std::max<std::int64_t>(0, x - reach)); u <= column(x + reach); ++u) {
      tiles_[static_cast<std::size_t>(v * columns_ + u)].push_back(index);
    }
  }
}

bool IndirectPoints::covered(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                             std::uint32_t object) const {
  constexpr double least = (1.0 - inner * inner) * (1.0 - inner * inner);
  for (const std::uint32_t i : near(x, y)) {
    if (weight(points_[i], position, normal, object) >= least) { return true; }
  }
  return false;
}

void IndirectPoints::fit(std::size_t i) {
  IndirectPoint& point = points_[i];
  const auto [s, t] = radiosity::orthonormal(point.normal);
  point.s = s;
  point.t = t;
  // Sums of weights times (1, u, v) (1, u, v)' and times the light, with u, v in radii.
  double w = 0.0, u1 = 0.0, v1 = 0.0, uu = 0.0, uv = 0.0, vv = 0.0;
  radiosity::Color e{0.0}, eu{0.0}, ev{0.0};
  for (const std::uint32_t k : near(point.x, point.y)) {
    const IndirectPoint& other = points_[k];
    const double own = weight(point, other.position, other.normal, other.object);
    if (!(own > 0.0)) { continue; }
    const glm::dvec3 d = (other.position - point.position) / point.radius;
    const double u = glm::dot(d, s), v = glm::dot(d, t);
    w += own, u1 += own * u, v1 += own * v, uu += own * u * u, uv += own * u * v, vv += own * v * v;
    e += own * other.gathered, eu += own * u * other.gathered, ev += own * v * other.gathered;
  }
  // About the weighted mean; what holds the slopes down where points are few or in line is small beside the ball.
  const double mu = u1 / w, mv = v1 / w;
  const radiosity::Color mean = e / w;
  const double hold = 0.001 * w;
  const double a = uu - w * mu * mu + hold, b = uv - w * mu * mv, c = vv - w * mv * mv + hold;
  const radiosity::Color ru = eu - e * mu, rv = ev - e * mv;
  const double determinant = a * c - b * b;
  const radiosity::Color slope_u = (ru * c - rv * b) / determinant, slope_v = (rv * a - ru * b) / determinant;
  point.light = glm::max(mean - slope_u * mu - slope_v * mv, radiosity::Color{0.0});
  point.by_s = slope_u / point.radius;
  point.by_t = slope_v / point.radius;
}

std::optional<radiosity::Color> IndirectPoints::at(std::uint32_t x, std::uint32_t y, const glm::dvec3& position, const glm::dvec3& normal,
                                                   std::uint32_t object) const {
  radiosity::Color sum{0.0};
  double weights = 0.0;
  for (const std::uint32_t i : near(x, y)) {
    const IndirectPoint& point = points_[i];
    const double own = weight(point, position, normal, object);
    if (!(own > 0.0)) { continue; }
    const glm::dvec3 d = position - point.position;
    sum += own * (point.light + glm::dot(d, point.s) * point.by_s + glm::dot(d, point.t) * point.by_t);
    weights += own;
  }
  if (!(weights > 0.0)) { return std::nullopt; }
  return glm::max(sum / weights, radiosity::Color{0.0});
}

}  // namespace apps
