// SPDX-License-Identifier: MIT
#include <radiosity/discontinuity/direct_variation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/inline.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

inline constexpr unsigned grid = 6;

struct LightSamples {
  std::array<glm::dvec3, grid * grid> at;
  std::array<Color, grid * grid> light;
};

// The variance between both sides of a plane, and how well both parts are proportioned.
[[nodiscard]] HALFLIGHT_INLINE double between(const LightSamples& samples, const CutPlane& cut) {
  Color low{0.0}, high{0.0};
  double lows = 0.0, highs = 0.0;
  for (std::size_t i = 0; i < samples.at.size(); ++i) {
    const bool above = glm::dot(cut.normal, samples.at[i] - cut.point) > 0.0;
    (above ? high : low) += samples.light[i];
    (above ? highs : lows) += 1.0;
  }
  if (lows == 0.0 || highs == 0.0) { return 0.0; }
  const Color difference = high / highs - low / lows;
  return lows * highs / ((lows + highs) * (lows + highs)) * glm::dot(difference, difference);
}

// Length over width of a convex polygon with this normal: its diameter squared over its area.
[[nodiscard]] HALFLIGHT_INLINE double length_over_width(const Polygon& polygon) {
  double far = 0.0;
  for (const glm::dvec3& a : polygon) {
    for (const glm::dvec3& b : polygon) { far = std::max(far, glm::dot(a - b, a - b)); }
  }
  const double area = polygon.size() < 3 ? 0.0 : glm::length(vector_area(polygon));
  return area > 0.0 ? far / area : 1e300;
}

}  // namespace detail

HALFLIGHT_INLINE PatchVariation patch_variation(LitRegion& region, const Patch& patch, const Color& reflectance,
                                                const std::vector<CriticalLine>& lines) {
  detail::LightSamples samples;
  Color mean{0.0};
  double square = 0.0;
  constexpr double count = detail::grid * detail::grid;
  for (unsigned i = 0; i < detail::grid; ++i) {
    for (unsigned k = 0; k < detail::grid; ++k) {
      const std::size_t n = i * detail::grid + k;
      samples.at[n] = sample(patch, (i + 0.5) / detail::grid, (k + 0.5) / detail::grid);
      samples.light[n] = reflectance * region.irradiance(samples.at[n], patch.normal);
      mean += samples.light[n] / count;
      square += glm::dot(samples.light[n], samples.light[n]) / count;
    }
  }
  PatchVariation result;
  result.variance = std::max(0.0, square - glm::dot(mean, mean));
  // Parts may be as long as the patch itself where that is longer than they should be.
  const double own = detail::length_over_width(patch.contour);
  const double longest = std::max(longest_cut_part, own);
  double best = -1.0;
  const auto consider = [&](const CutPlane& cut, double bonus) {
    Polygon below, above;
    clip_to_horizon(patch.contour, cut.point, cut.normal, above);
    clip_to_horizon(patch.contour, cut.point, -cut.normal, below);
    const double shape = std::max(detail::length_over_width(above), detail::length_over_width(below));
    if (!(shape <= longest * 1.000001)) { return; }
    // Of equal gains the better proportioned parts: the second term is at most a hundredth of the variance.
    const double gain = detail::between(samples, cut) * bonus + 0.01 * (result.variance + 1e-12 * square + 1e-300) / shape;
    if (gain > best * (1.0 + 1e-9)) {
      best = gain;
      result.cut = cut;
    }
  };
  for (std::size_t i = 0; i < patch.contour.size(); ++i) {
    const glm::dvec3 side = patch.contour[i + 1 < patch.contour.size() ? i + 1 : 0] - patch.contour[i];
    if (glm::length(side) > 0.0) { consider({patch.centroid, glm::normalize(glm::cross(patch.normal, side))}, 1.0); }
  }
  for (const CriticalLine& line : lines) {
    consider({line.from, glm::normalize(glm::cross(patch.normal, line.to - line.from))}, 2.0);
  }
  return result;
}

}  // namespace radiosity
