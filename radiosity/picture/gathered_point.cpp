// SPDX-License-Identifier: MIT
#include <radiosity/picture/gathered_point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/scene/material.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

inline constexpr double inner_sphere = 0.7;  // relative to the radius of a sphere
inline constexpr double same_way = 0.9;      // least cosine between the normals of points that share light
// Relative to the radius of a sphere: points farther off its tangent plane belong to another surface.
inline constexpr double out_of_plane = 0.2;
inline constexpr double explained_by_noise = 1.25;  // largest PlaneFit::misfit
// Limits of a plane beyond the range of its points: in units of the range's width, and as a factor.
inline constexpr double beyond_range = 0.5, most_beyond = 2.0;
inline constexpr double little_left = 0.05;  // a residual of this share of the mean light is accepted, whatever the noise
// A point is doubtful if it deviates from the plane of at least least_others points by this share of their light, and by this many
// standard errors of itself and the residuals.
inline constexpr double seen_off = gather_rays.error, errors_off = 2.5;
inline constexpr std::size_t least_others = 6;

// A plane fitted to the light of the points in a sphere.
struct PlaneFit {
  Color light{0.0}, by_u{0.0}, by_v{0.0};  // at the centre, and the changes over one radius
  Color mean{0.0}, least{0.0}, most{0.0};  // of its points
  double misfit = 0.0;                     // squared residuals of the fit, relative to those expected from the noise of the points
  double rest = 0.0;                       // mean squared residual, relative to the squared mean light
};

[[nodiscard]] HALFLIGHT_INLINE PlaneFit fit_plane(const GatheredPoint& point, double sphere, std::span<const GatheredPoint* const> near) {
  // Sums of weight * (1, u, v) (1, u, v)' and of weight * light, with u, v in radii.
  double w = 0.0, u1 = 0.0, v1 = 0.0, uu = 0.0, uv = 0.0, vv = 0.0;
  Color e{0.0}, eu{0.0}, ev{0.0};
  const auto each = [&](const auto& use) {
    for (const GatheredPoint* other : near) {
      double own = point.weight(other->position, other->normal, other->object, sphere);
      if (!(own > 0.0)) { continue; }
      own *= std::min(1.0, other->radius * other->radius / (point.radius * point.radius));
      const glm::dvec3 d = (other->position - point.position) / sphere;
      use(own, glm::dot(d, point.s), glm::dot(d, point.t), *other);
    }
  };
  each([&](double own, double u, double v, const GatheredPoint& other) {
    w += own, u1 += own * u, v1 += own * v, uu += own * u * u, uv += own * u * v, vv += own * v * v;
    e += own * other.gathered, eu += own * u * other.gathered, ev += own * v * other.gathered;
  });
  // Relative to the weighted mean. `hold` regularizes the slopes if points are few or collinear; it is small compared with the sphere.
  const double mu = u1 / w, mv = v1 / w;
  const Color mean = e / w;
  const double hold = 0.001 * w;
  const double a = uu - w * mu * mu + hold, b = uv - w * mu * mv, c = vv - w * mv * mv + hold;
  const Color ru = eu - e * mu, rv = ev - e * mv;
  const double determinant = a * c - b * b;
  PlaneFit plane;
  plane.by_u = (ru * c - rv * b) / determinant;
  plane.by_v = (rv * a - ru * b) / determinant;
  plane.light = mean - plane.by_u * mu - plane.by_v * mv;
  plane.mean = plane.least = plane.most = mean;
  double left = 0.0, noise = 0.0;
  each([&](double own, double u, double v, const GatheredPoint& other) {
    const Color rest = other.gathered - plane.light - u * plane.by_u - v * plane.by_v;
    left += own * sum_of_channels(rest) * sum_of_channels(rest);
    plane.least = glm::min(plane.least, other.gathered);
    plane.most = glm::max(plane.most, other.gathered);
    noise += own * other.variance;
  });
  plane.misfit = left > 0.0 ? left / noise : 0.0;
  const double sum_of_mean = sum_of_channels(mean);
  plane.rest = left > 0.0 ? left / (w * sum_of_mean * sum_of_mean) : 0.0;
  return plane;
}

}  // namespace detail

HALFLIGHT_INLINE double GatheredPoint::weight(const glm::dvec3& place, const glm::dvec3& normal_there, std::uint32_t object_there,
                                              double sphere) const {
  if (object != object_there) { return 0.0; }
  const glm::dvec3 d = place - position;
  const double part = glm::dot(d, d) / (sphere * sphere);
  if (!(part < 1.0)) { return 0.0; }
  const double cosine = glm::dot(normal, normal_there);
  if (!(cosine > detail::same_way) || std::abs(glm::dot(d, normal)) > detail::out_of_plane * sphere) { return 0.0; }
  const double turned = (cosine - detail::same_way) / (1.0 - detail::same_way);
  return (1.0 - part) * (1.0 - part) * turned;
}

HALFLIGHT_INLINE bool GatheredPoint::covers(const glm::dvec3& place, const glm::dvec3& normal_there, std::uint32_t object_there) const {
  constexpr double inner = (1.0 - detail::inner_sphere * detail::inner_sphere) * (1.0 - detail::inner_sphere * detail::inner_sphere);
  return weight(place, normal_there, object_there) >= inner;
}

HALFLIGHT_INLINE Color GatheredPoint::at(const glm::dvec3& place) const {
  const glm::dvec3 d = place - position;
  const Color beyond_mean = light + glm::dot(d, s) * by_s + glm::dot(d, t) * by_t - mean;
  double part = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double allowed = (beyond_mean[k] < 0.0 ? least[k] : most[k]) - mean[k];
    if (std::abs(beyond_mean[k]) > std::abs(allowed)) { part = std::min(part, allowed / beyond_mean[k]); }
  }
  return mean + part * beyond_mean;
}

HALFLIGHT_INLINE bool is_doubtful(const GatheredPoint& gathered, std::span<const GatheredPoint* const> near) {
  GatheredPoint point = gathered;
  const auto [s, t] = orthonormal(point.normal);
  point.s = s;
  point.t = t;
  const double own = sum_of_channels(point.gathered);
  std::vector<const GatheredPoint*> others;
  for (const GatheredPoint* other : near) {
    if (other != &gathered && point.weight(other->position, other->normal, other->object, point.widest) > 0.0) { others.push_back(other); }
  }
  if (others.size() < detail::least_others) { return false; }
  const detail::PlaneFit plane = detail::fit_plane(point, point.widest, others);
  // The residuals of the other points, by their median, so that another stain among them does not hide this one.
  std::vector<double> left;
  for (const GatheredPoint* other : others) {
    const glm::dvec3 d = (other->position - point.position) / point.widest;
    const Color rest = other->gathered - plane.light - glm::dot(d, point.s) * plane.by_u - glm::dot(d, point.t) * plane.by_v;
    left.push_back(std::abs(sum_of_channels(rest)));
  }
  const auto middle = left.begin() + static_cast<std::ptrdiff_t>(left.size() / 2);
  std::nth_element(left.begin(), middle, left.end());
  constexpr double of_median = 1.4826;  // standard deviation over median, for normal residuals
  const double off = own - sum_of_channels(plane.light), mean = sum_of_channels(plane.mean);
  const double noise = point.variance + std::pow(of_median * *middle, 2.0);
  return std::abs(off) > detail::seen_off * mean && off * off > detail::errors_off * detail::errors_off * noise;
}

HALFLIGHT_INLINE void fit(GatheredPoint& point, std::span<const GatheredPoint* const> near) {
  const auto [s, t] = orthonormal(point.normal);
  point.s = s;
  point.t = t;
  constexpr double step = 1.5;
  double sphere = point.widest;
  detail::PlaneFit plane = detail::fit_plane(point, sphere, near);
  while (sphere > point.radius && !(plane.misfit <= detail::explained_by_noise)) {
    sphere = std::max(point.radius, sphere / step);
    plane = detail::fit_plane(point, sphere, near);
  }
  point.light = plane.light;
  point.by_s = plane.by_u / sphere;
  point.by_t = plane.by_v / sphere;
  const bool explained = plane.misfit <= detail::explained_by_noise || plane.rest <= detail::little_left * detail::little_left;
  const Color beyond = explained ? detail::beyond_range * (plane.most - plane.least) : Color{0.0};
  point.mean = plane.mean;
  point.least = glm::max(plane.least - beyond, plane.least / detail::most_beyond);
  point.most = glm::min(plane.most + beyond, plane.most * detail::most_beyond);
}

}  // namespace radiosity
