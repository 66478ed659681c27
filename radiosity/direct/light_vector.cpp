// SPDX-License-Identifier: MIT
#include <radiosity/direct/light_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

HALFLIGHT_INLINE PossibleOutline::PossibleOutline(const Facets& facets, const Facets::Part& part, const PointRegion& region) {
  enum class Faced : unsigned char { by_all, by_none, by_some };
  std::vector<Faced> faced;
  std::vector<std::uint32_t> number(part.facets_end - part.facets_begin, brep::invalid_index);
  for (std::uint32_t f = part.facets_begin; f < part.facets_end; ++f) {
    const double height = facets.facets[f].height(region.centre);
    faced.push_back(height > region.radius ? Faced::by_all : height < -region.radius ? Faced::by_none : Faced::by_some);
  }
  const auto take = [&](std::uint32_t f) {
    std::uint32_t& own = number[f - part.facets_begin];
    if (own == brep::invalid_index) {
      own = static_cast<std::uint32_t>(planes_.size());
      planes_.push_back({facets.facets[f].normal, facets.facets[f].offset});
      if (faced[f - part.facets_begin] == Faced::by_some) { largest_turning_ = std::max(largest_turning_, facets.facets[f].area); }
    }
    return own;
  };
  for (std::uint32_t e = part.edges_begin; e < part.edges_end; ++e) {
    const Facets::Edge& edge = facets.edges[e];
    const bool border = edge.right == brep::invalid_index;
    const Faced left = faced[edge.left - part.facets_begin];
    const Faced right = border ? Faced::by_none : faced[edge.right - part.facets_begin];
    if (left == right && left != Faced::by_some) { continue; }
    const std::uint32_t number_of_left = take(edge.left);
    edges_.push_back({edge.a, edge.b, number_of_left, border ? brep::invalid_index : take(edge.right)});
  }
}

HALFLIGHT_INLINE glm::dvec3 PossibleOutline::light_vector(const glm::dvec3& x, double slack, std::vector<char>& facing) const {
  facing.clear();
  for (const Plane& plane : planes_) { facing.push_back(glm::dot(plane.normal, x) - plane.offset > slack ? 1 : 0); }
  glm::dvec3 sum{0.0};
  for_outline(edges_, facing, [&](const glm::dvec3& a, const glm::dvec3& b) { sum += contour_vector(x, a, b); });
  return sum / (2.0 * std::numbers::pi);
}

HALFLIGHT_INLINE std::optional<LinearLightVector> LinearLightVector::fit(const Facets::Part& part, const PossibleOutline& outline,
                                                                         const PointRegion& region, double slack,
                                                                         std::vector<char>& facing) {
  const auto& [centre, radius, normal] = region;
  constexpr double near = 4.0;  // minimum distance in radii of the region; nearer, the fit is not accurate
  if (!(glm::length(part.centre - centre) > near * radius)) { return std::nullopt; }
  const auto scaled = [&](const glm::dvec3& x) {
    const double r = glm::length(part.centre - x);
    return outline.light_vector(x, slack, facing) * (r * r * r);
  };
  LinearLightVector result;
  result.body_ = part.centre;
  result.centre_ = centre;
  result.value_ = scaled(centre);
  if (!(radius > 0.0)) { return result; }
  const bool planar = region.planar();
  const glm::dvec3 n = planar ? normal : glm::dvec3{0.0, 0.0, 1.0};
  const auto [s, t] = orthonormal(n);
  result.axes_ = {s, t, n};
  constexpr double tolerance = 5e-4;
  const double largest_bend = tolerance * glm::length(result.value_);
  for (std::size_t k = 0; k < (planar ? 2 : 3); ++k) {
    const glm::dvec3 before = scaled(centre - radius * result.axes_[k]), after = scaled(centre + radius * result.axes_[k]);
    if (!(glm::length(0.5 * (before + after) - result.value_) <= largest_bend)) { return std::nullopt; }
    result.slopes_[k] = (after - before) / (2.0 * radius);
  }
  // Where a large facet turns into view, V has a crease. The axes may miss up to this fraction of the light behind the crease, the
  // corners less.
  const double crease = radius * outline.largest_turning() / std::numbers::pi;
  constexpr double missed_by_axes = 0.6, missed_by_corners = 0.1;
  if (missed_by_axes * crease <= largest_bend) { return result; }
  if (missed_by_corners * crease > largest_bend) { return std::nullopt; }
  for (int corner = 0; corner < (planar ? 4 : 8); ++corner) {
    const auto sign = [&](int k) { return (corner >> k & 1) != 0 ? 1.0 : -1.0; };
    const glm::dvec3 x = centre + radius * glm::normalize(sign(0) * s + sign(1) * t + (planar ? 0.0 : sign(2)) * n);
    const glm::dvec3 exact = outline.light_vector(x, slack, facing);
    if (!(glm::length(result.at(x) - exact) <= tolerance * glm::length(exact))) { return std::nullopt; }
  }
  return result;
}

HALFLIGHT_INLINE glm::dvec3 LinearLightVector::at(const glm::dvec3& x) const {
  glm::dvec3 scaled = value_;
  for (std::size_t k = 0; k < axes_.size(); ++k) { scaled += glm::dot(axes_[k], x - centre_) * slopes_[k]; }
  const glm::dvec3 d = body_ - x;
  const double r2 = glm::dot(d, d);
  return scaled / (r2 * std::sqrt(r2));
}

HALFLIGHT_INLINE double roundness(const Facets& facets, const Facets::Part& part) {
  constexpr double tolerance = 0.002;
  constexpr int directions = 24;  // uniformly distributed on a Fibonacci spiral
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  struct Seen {
    glm::dvec3 out, light;  // direction, and the light there times the squared distance
  };
  std::vector<char> facing;
  std::vector<Seen> all;
  double mean = 0.0;  // over the directions it errs less than any of them (Cauchy 1832)
  for (int k = 0; k < directions; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / directions, across = std::sqrt(1.0 - z * z);
    const glm::dvec3 out{across * std::cos(turn * k), across * std::sin(turn * k), z};
    for (const double radii : {100.0, 1.1}) {
      const double distance = radii * part.radius;
      const glm::dvec3 x = part.centre + distance * out;
      all.push_back({out, PossibleOutline{facets, part, {x}}.light_vector(x, 0.0, facing) * (distance * distance)});
      mean += glm::length(all.back().light) / (2.0 * directions);
    }
  }
  const auto differs = [&](const Seen& seen) { return !(glm::length(seen.light + mean * seen.out) <= tolerance * mean); };
  return std::any_of(all.begin(), all.end(), differs) ? 0.0 : mean;
}

}  // namespace radiosity
