// SPDX-License-Identifier: MIT
#include <radiosity/discontinuity/direct_variation.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

struct LightSamples {
  static constexpr std::size_t side = 6, count = side * side;
  std::array<glm::dvec3, count> at;
  std::array<Color, count> light;
};

// The variance that a cut removes: the variance between the means of both sides.
[[nodiscard]] HALFLIGHT_INLINE double variance_between(const LightSamples& samples, const CutPlane& cut) {
  std::array<Color, 2> sum{Color{0.0}, Color{0.0}};
  std::array<double, 2> count{};
  for (std::size_t i = 0; i < LightSamples::count; ++i) {
    const std::size_t above = glm::dot(cut.normal, samples.at[i] - cut.point) > 0.0 ? 1 : 0;
    sum[above] += samples.light[i];
    count[above] += 1.0;
  }
  if (count[0] == 0.0 || count[1] == 0.0) { return 0.0; }
  const Color difference = sum[1] / count[1] - sum[0] / count[0];
  constexpr double all = LightSamples::count;
  return count[0] * count[1] / (all * all) * glm::dot(difference, difference);
}

// Squared diameter over area; for an elongated polygon, about its length over its width.
[[nodiscard]] HALFLIGHT_INLINE double length_over_width(const Polygon& polygon) {
  double square = 0.0;
  for (const glm::dvec3& a : polygon) {
    for (const glm::dvec3& b : polygon) { square = std::max(square, glm::dot(a - b, a - b)); }
  }
  const double area = polygon.size() < 3 ? 0.0 : glm::length(vector_area(polygon));
  return area > 0.0 ? square / area : std::numeric_limits<double>::infinity();
}

// The larger length over width of the two parts.
[[nodiscard]] HALFLIGHT_INLINE double worst_part(const Polygon& contour, const CutPlane& cut) {
  Polygon above;
  Polygon below;
  clip_to_horizon(contour, cut.point, cut.normal, above);
  clip_to_horizon(contour, cut.point, -cut.normal, below);
  return std::max(length_over_width(above), length_over_width(below));
}

}  // namespace detail

HALFLIGHT_INLINE DirectVariation direct_variation(LitRegion& region, const Patch& patch, const Color& reflectance,
                                                  const std::vector<CriticalLine>& lines) {
  using detail::LightSamples;
  LightSamples samples;
  std::vector<std::array<double, 2>> arrives(region.size(), {0.0, 0.0});  // light of each lamp that arrives, and its unoccluded light
  Color mean{0.0};
  DirectVariation result;
  double& square = result.square;
  for (std::size_t i = 0; i < LightSamples::count; ++i) {
    const auto u = static_cast<double>(i % LightSamples::side);
    const auto v = static_cast<double>(i / LightSamples::side);
    samples.at[i] = sample(patch, (u + 0.5) / LightSamples::side, (v + 0.5) / LightSamples::side);
    Color light{0.0};
    for (std::size_t k = 0; k < region.size(); ++k) {
      const double form_factor = region.form_factor(k, samples.at[i], patch.normal);
      light += region.lamp(k).exitance * form_factor;
      arrives[k][0] += form_factor;
      if (region.may_be_hidden(k)) { arrives[k][1] += region.unhidden(k, samples.at[i], patch.normal); }
    }
    samples.light[i] = reflectance * light;
    mean += samples.light[i] / static_cast<double>(LightSamples::count);
    square += glm::dot(samples.light[i], samples.light[i]) / static_cast<double>(LightSamples::count);
  }
  result.variance = std::max(0.0, square - glm::dot(mean, mean));
  for (std::size_t k = 0; k < region.size(); ++k) {
    if (arrives[k][1] > 0.0) { result.seen.push_back({region.lamp(k).surface, arrives[k][0] / arrives[k][1]}); }
  }

  constexpr double even = 1.0 + 0x1p-20;  // so that rounding does not decide between the sides of a square
  const double longest = std::max(longest_cut_part, detail::length_over_width(patch.contour)) * even;
  double most = -1.0;
  for (std::size_t i = 0; i < patch.contour.size(); ++i) {
    const glm::dvec3 side = patch.contour[i + 1 < patch.contour.size() ? i + 1 : 0] - patch.contour[i];
    if (!(glm::length(side) > 0.0)) { continue; }
    const CutPlane cut{patch.centroid, glm::normalize(glm::cross(patch.normal, side))};
    const double proportion = detail::worst_part(patch.contour, cut);
    if (!(proportion <= longest)) { continue; }
    // Where the light is nearly constant, the proportions of the parts decide.
    const double gain = detail::variance_between(samples, cut) + (0.01 * result.variance + 1e-9 * square + 1e-300) / proportion;
    if (!(gain > most * even)) { continue; }
    most = gain;
    result.halves = cut;
  }
  const double least = result.halves ? 0.5 * detail::variance_between(samples, *result.halves) : 0.0;
  double best = std::max(least, 1e-6 * square);
  for (const CriticalLine& line : lines) {
    const CutPlane cut{line.from, glm::normalize(glm::cross(patch.normal, line.to - line.from))};
    const double gain = detail::variance_between(samples, cut);
    if (!(gain > best * even) || !(detail::worst_part(patch.contour, cut) <= longest)) { continue; }
    best = gain;
    result.along = cut;
  }
  return result;
}

}  // namespace radiosity
