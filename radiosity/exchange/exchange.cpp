// SPDX-License-Identifier: MIT
#include <radiosity/exchange/exchange.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/exchange/edge_pair.hpp>
#include <radiosity/exchange/kernel_sums.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/bend.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/instruction_sets.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE std::vector<Edge> edges_of(std::span<const glm::dvec3> contour) {
  std::vector<Edge> edges;
  edges.reserve(contour.size());
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const glm::dvec3 d = contour[(i + 1) % contour.size()] - contour[i];
    const double length = glm::length(d);
    if (length > 0.0) { edges.push_back({contour[i], d / length, length}); }
  }
  return edges;
}

HALFLIGHT_INLINE double contour_exchange(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double scale, double tolerance) {
  const std::vector<Edge> a = edges_of(p);
  const std::vector<Edge> b = edges_of(q);
  // The tolerance is divided equally among the pairs of edges.
  const double share = 2.0 * std::numbers::pi * tolerance / (scale * scale * static_cast<double>(a.size() * b.size()));
  double sum = 0.0;
  int asked = 0;
  for (const Edge& e : a) {
    for (const Edge& f : b) {
      // Lengths are scaled so that r is at most 1; the scale cancels in closed contour integrals. An edge of length 1 then has
      // |int ln r| <= 1.7 (the maximum, with r = 0 at its middle), which bounds pairs that can be skipped.
      const Edge es{(e.start - p[0]) / scale, e.direction, e.length / scale};
      const Edge fs{(f.start - p[0]) / scale, f.direction, f.length / scale};
      const double cosine = glm::dot(e.direction, f.direction);
      if (1.7 * std::abs(cosine) * std::min(es.length, fs.length) <= share) { continue; }
      sum += cosine * edge_pair(es, fs, share / std::abs(cosine), asked);
    }
  }
  return sum * scale * scale / (2.0 * std::numbers::pi);
}

// Far rule: sum over both rules of weight weight cos cos / (pi r^2).
[[nodiscard]] HALFLIGHT_INLINE double kernel_exchange(const Patch& p, std::span<const QuadraturePoint> rule_p, const Patch& q,
                                                      std::span<const QuadraturePoint> rule_q) {
  if (KernelPoints::fits(rule_p) && KernelPoints::fits(rule_q)) {
    const double sum = sum_of_kernel({p.normal, rule_p}, {q.normal, rule_q}, instruction_set());
    return std::max(0.0, sum / std::numbers::pi);
  }
  double sum = 0.0;  // for faces with many corners
  for (const QuadraturePoint& a : rule_p) {
    double row = 0.0;
    for (const QuadraturePoint& b : rule_q) {
      const glm::dvec3 d = b.position - a.position;
      const double r2 = glm::dot(d, d);
      row += b.weight * glm::dot(p.normal, d) * -glm::dot(q.normal, d) / (r2 * r2);
    }
    sum += a.weight * row;
  }
  return std::max(0.0, sum / std::numbers::pi);
}

// A patch much smaller than the other: Lambert's contour of the large one, averaged over the Gauss points of the small one.
[[nodiscard]] HALFLIGHT_INLINE double point_exchange(const Patch& small, const Patch& large) {
  double sum = 0.0;
  for (const QuadraturePoint& a : small.rule3) { sum += a.weight * point_to_polygon(a.position, small.normal, large.contour); }
  return sum;
}

}  // namespace detail

HALFLIGHT_INLINE int above_horizon(const Patch& p, const Patch& q, double share) {
  const double reach = q.radius + glm::length(q.centre - p.centre);
  const double coordinates = glm::length(p.centre) + glm::length(q.centre);
  const double rounding = std::numeric_limits<double>::epsilon() * coordinates * (1.0 + reach / p.radius);
  const double slack = share * (p.radius + reach) + rounding;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const glm::dvec3& x : q.contour) {
    const double height = glm::dot(p.normal, x - p.centre);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high <= slack ? -1 : low >= -slack ? 1 : 0;
}

namespace detail {

inline constexpr double near_extent = 0.6491;  // extent over distance above which the near rule is needed

// The linear fit to the light at the Gauss points of a patch (weights included); zero if there is no light.
[[nodiscard]] HALFLIGHT_INLINE Variation variation(const Patch& patch, std::span<const double> light) {
  Variation result;
  double sum = 0.0;
  double square = 0.0;
  double area = 0.0;
  glm::dvec3 moment{0.0};
  for (std::size_t i = 0; i < patch.rule3.size(); ++i) {
    const QuadraturePoint& a = patch.rule3[i];
    sum += light[i];
    square += light[i] * light[i] / a.weight;
    area += a.weight;
    moment += light[i] * (a.position - patch.centroid);
  }
  if (!(sum > 0.0)) { return result; }
  moment /= sum;
  result.slope = patch.inverse_inertia * moment;
  const double linear = glm::dot(result.slope, moment);  // slope . inertia . slope
  result.linear = std::sqrt(std::max(0.0, linear));
  result.rest = std::sqrt(std::max(0.0, square * area / (sum * sum) - 1.0 - linear));
  return result;
}

// As below, for any number of Gauss points.
[[nodiscard]] HALFLIGHT_INLINE Variations variations_of_many(const Patch& p, const Patch& q, double& square) {
  std::vector<double> light_p, light_q(q.rule3.size(), 0.0);
  std::vector<glm::dvec3> normal_q;
  for (const QuadraturePoint& b : q.rule3) { normal_q.push_back(normal_over(q, b.position)); }
  double sum = 0.0;
  for (const QuadraturePoint& a : p.rule3) {
    const glm::dvec3 normal_p = normal_over(p, a.position);
    double row = 0.0;
    for (std::size_t j = 0; j < q.rule3.size(); ++j) {
      const QuadraturePoint& b = q.rule3[j];
      const glm::dvec3 d = b.position - a.position;
      const double r2 = glm::dot(d, d);
      const double cosines = std::max(0.0, glm::dot(normal_p, d)) * std::max(0.0, -glm::dot(normal_q[j], d));
      const double kernel = cosines / (r2 * r2);
      const double light = a.weight * b.weight * kernel;
      row += light;
      square += light * kernel;
      light_q[j] += light;
    }
    light_p.push_back(row);
    sum += row;
  }
  return {variation(p, light_p), variation(q, light_q), 0.0, sum};
}

// The variations before limiting; `light` is still to be divided by pi. `square` receives the sum of the squared kernel with
// the weights of both points.
[[nodiscard]] HALFLIGHT_INLINE Variations variations_of_kernel(const Patch& p, const Patch& q, double& square) {
  square = 0.0;
  if (!KernelPoints::fits(p.rule3) || !KernelPoints::fits(q.rule3)) { return variations_of_many(p, q, square); }
  KernelLight light;
  light_of_kernel({p, p.rule3}, {q, q.rule3}, light, instruction_set());
  square = light.square;
  return {variation(p, {light.on_p, p.rule3.size()}), variation(q, {light.on_q, q.rule3.size()}), 0.0, light.total};
}

}  // namespace detail

HALFLIGHT_INLINE Variations variations(const Patch& p, const Patch& q) {
  double square = 0.0;
  Variations result = detail::variations_of_kernel(p, q, square);
  const double sum = result.light;
  result.light = sum / std::numbers::pi;
  const auto variance = [](const Variation& v) { return v.linear * v.linear + v.rest * v.rest; };
  if (sum > 0.0) {
    const double all = square * p.area * q.area / (sum * sum) - 1.0;
    result.cross = std::sqrt(std::max(0.0, all - variance(result.p) - variance(result.q)));
  }
  const auto lit_in_part = [](const Patch& patch, const Patch& other, Variation& v) {
    if (above_horizon(other, patch) != 0) { return; }
    Polygon lit;
    clip_to_horizon(patch.contour, other.centre, other.normal, lit);
    const double area = lit.size() < 3 ? 0.0 : glm::length(vector_area(lit));
    if (area > 0.0) { v.rest = std::max(v.rest, std::sqrt(std::max(0.0, patch.area / area - 1.0 - v.linear * v.linear))); }
  };
  lit_in_part(p, q, result.p);
  lit_in_part(q, p, result.q);
  const auto steepest = [](const Patch& patch, const glm::dvec3& slope) {
    double fall = 0.0;
    for (const glm::dvec3& x : patch.contour) { fall = std::max(fall, -glm::dot(slope, x - patch.centroid)); }
    return fall;
  };
  const double fall = steepest(p, result.p.slope) + steepest(q, result.q.slope);
  if (fall > 1.0) {
    for (Variation* v : {&result.p, &result.q}) {
      v->slope /= fall;
      v->limited = v->linear * (1.0 - 1.0 / fall);
      v->linear /= fall;
    }
  }
  return result;
}

HALFLIGHT_INLINE Variation variation_by_contour(const Patch& p, const Patch& q) {
  std::vector<double> light;
  light.reserve(p.rule3.size());
  Polygon seen;
  for (const QuadraturePoint& x : p.rule3) {
    const glm::dvec3 normal = normal_over(p, x.position);
    light.push_back(0.0);
    if (!(glm::dot(q.normal, x.position - q.centre) > 0.0)) { continue; }
    seen.clear();
    clip_to_horizon(q.contour, x.position, normal, seen);
    if (seen.size() >= 3) { light.back() = x.weight * std::max(0.0, point_to_polygon(x.position, normal, seen)); }
  }
  return detail::variation(p, light);
}

HALFLIGHT_INLINE bool too_near_for_kernel(const Patch& p, const Patch& q) {
  return p.radius + q.radius >= detail::near_extent * glm::length(q.centre - p.centre);
}

namespace detail {

HALFLIGHT_INLINE Patch above(const Patch& patch, const Patch& other) {
  Polygon contour;
  clip_to_horizon(patch.contour, other.centre, other.normal, contour);
  if (contour.size() < 3) { return {}; }
  std::vector<Polygon> parts;
  for (const Polygon& part : patch.parts) {
    Polygon upper;
    clip_to_horizon(part, other.centre, other.normal, upper);
    if (upper.size() >= 3) { parts.push_back(std::move(upper)); }
  }
  return make_patch(std::move(contour), std::move(parts));
}

// The greatest distance of a corner from the plane of the patch.
[[nodiscard]] HALFLIGHT_INLINE double unevenness(const Patch& patch) {
  double most = 0.0;
  for (const glm::dvec3& x : patch.contour) { most = std::max(most, std::abs(glm::dot(patch.normal, x - patch.centre))); }
  return most;
}

// For patches that lie above each other's horizon. `known`: variations(p, q), if already computed.
[[nodiscard]] HALFLIGHT_INLINE double facing_exchange(const Patch& p, const Patch& q, const Variations* known) {
  // Ratio: extent over distance. Gauss rules of 2, 3, 4 points a side have errors below 6 (ratio/3)^4, 4 (ratio/3)^6, 3 (ratio/3)^8.
  const double distance = glm::length(q.centre - p.centre);
  const double extent = p.radius + q.radius;
  // The limits are not round numbers, because patches of regular meshes often have round ratios, and rounding would then choose
  // the rule.
  // Summed by the rule of three points a side.
  if (known != nullptr && !p.bent && !q.bent && extent < 0.3493 * distance) { return known->light; }
  if (extent < 0.0997 * distance) { return kernel_exchange(p, p.rule2, q, q.rule2); }
  if (extent < 0.3493 * distance) { return kernel_exchange(p, p.rule3, q, q.rule3); }
  if (extent < near_extent * distance) { return kernel_exchange(p, p.rule4, q, q.rule4); }
  // A patch a thousand times smaller than the other is nearly a point, and the contour integrals would cancel almost completely.
  if (p.radius < 0.997e-3 * q.radius) { return point_exchange(p, q); }
  if (q.radius < 0.997e-3 * p.radius) { return point_exchange(q, p); }
  const double scale = extent + distance;
  const double tolerance = 1e-8 * std::min(p.area, q.area);
  return std::max(0.0, contour_exchange(p.contour, q.contour, scale, tolerance));
}

}  // namespace detail

HALFLIGHT_INLINE double exchange(const Patch& p, const Patch& q, const Variations* known) {
  const int q_side = above_horizon(p, q);
  const int p_side = above_horizon(q, p);
  if (p_side < 0 || q_side < 0 || !(p.area > 0.0) || !(q.area > 0.0)) { return 0.0; }
  if (p_side > 0 && q_side > 0) { return detail::facing_exchange(p, q, known); }
  // Faces that lie on each other intersect at a tiny angle if their corners are rounded, so a part that rises by less than 1e-8 of the
  // extent counts as touching. Contours on a curved surface, or with rounded corners, are not quite planar: a part that rises by no more
  // than this unevenness does not face the other patch (neighbours on a sphere), and a clipped patch may reach below the horizon by as
  // much.
  const Patch cut_p = detail::above(p, q);
  const Patch cut_q = detail::above(q, p);
  if (!(cut_p.area > 0.0) || !(cut_q.area > 0.0)) { return 0.0; }
  const double extent = p.radius + q.radius + glm::length(q.centre - p.centre);
  const double share = std::max(1e-8, 2.0 * (detail::unevenness(p) + detail::unevenness(q)) / extent);
  if (above_horizon(p, cut_q, share) < 0 || above_horizon(q, cut_p, share) < 0) { return 0.0; }
  return detail::facing_exchange(cut_p, cut_q, nullptr);
}

}  // namespace radiosity
