// SPDX-License-Identifier: MIT
#include <radiosity/camera/shadow_edges.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <brep/inline.hpp>

namespace radiosity {
namespace detail {

// The light of each lamp of the region at some places.
struct LightOfLamps {
  struct OfLamp {
    Color mean{0.0};
    double difference = 0.0;  // between the places; of the sum of the channels
  };
  std::vector<OfLamp> lamps;
  std::vector<double> all;  // of all lamps and the others at each place, sum of the channels
  double most = 0.0;        // of these
};

HALFLIGHT_INLINE Color light_of(LitRegion& region, std::size_t lamp, const FinalGather::Place& place, const Color& others) {
  return region.lamp(lamp).exitance * region.form_factor(lamp, place.point.position, place.point.normal, others);
}

// By how much values at places of a pixel differ from the plane that fits them best: the range of what that leaves. A step remains, a slope
// does not.
HALFLIGHT_INLINE double off_plane(std::span<const double> values, std::span<const PixelPlace> places) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0;
  glm::dvec2 middle{0.0}, along{0.0};
  for (std::size_t i = 0; i < values.size(); ++i) {
    mean += values[i] / n;
    middle += places[i].at / n;
  }
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::dvec2 d = places[i].at - middle;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
    along += (values[i] - mean) * d;
  }
  const double det = xx * yy - xy * xy;
  constexpr double in_line = 1e-3;  // places so nearly in line fit any slope across
  const bool fits = det > in_line * (xx + yy) * (xx + yy) && values.size() > 3;
  const glm::dvec2 slope = fits ? glm::dvec2{yy * along.x - xy * along.y, xx * along.y - xy * along.x} / det : glm::dvec2{0.0};
  double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::dvec2 d = places[i].at - middle;
    const double left = values[i] - slope.x * d.x - slope.y * d.y;
    least = std::min(least, left);
    most = std::max(most, left);
  }
  return most - least;
}

HALFLIGHT_INLINE LightOfLamps light_of_lamps(LitRegion& region, std::span<const PixelPlace> places, const Color& others) {
  const auto difference = [](std::span<const double> values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return *most - *least;
  };
  LightOfLamps result;
  result.lamps.resize(region.size());
  std::vector<Color> so_far(places.size(), others);  // at each place
  std::vector<double> of_lamp(places.size());
  result.all.resize(places.size());
  for (std::size_t k = 0; k < region.size(); ++k) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Color light = light_of(region, k, places[i].place, so_far[i]);
      so_far[i] += light;
      of_lamp[i] = sum_of_channels(light);
      result.lamps[k].mean += light / static_cast<double>(places.size());
    }
    result.lamps[k].difference = difference(of_lamp);
  }
  std::transform(so_far.begin(), so_far.end(), result.all.begin(), sum_of_channels);
  result.most = *std::max_element(result.all.begin(), result.all.end());
  return result;
}

// Of a step of 1 along a straight edge, this much at least is left at the middle and SeenSurfaces::four, or at Hammersley's 16 points.
inline constexpr double left_of_step_at_5 = 0.5, left_of_step_at_16 = 0.74;

HALFLIGHT_INLINE bool has_step(const LightOfLamps& light, std::span<const PixelPlace> places, double left) {
  return off_plane(light.all, places) > left * change_at_edge * light.most;
}

}  // namespace detail

HALFLIGHT_INLINE MeanLight mean_light(LitRegion& region, std::span<const PixelPlace> places, const Color& others) {
  const detail::LightOfLamps found = detail::light_of_lamps(region, places, others);
  MeanLight result{Color{0.0}, detail::has_step(found, places, detail::left_of_step_at_16), found.all};
  for (double& light : result.light) { light -= sum_of_channels(others); }
  for (const auto& lamp : found.lamps) { result.direct += lamp.mean; }
  return result;
}

HALFLIGHT_INLINE MeanLight mean_light(LitRegion& region, std::span<const PixelPlace> few, std::span<const PixelPlace> many,
                                      const Color& others) {
  const detail::LightOfLamps found = detail::light_of_lamps(region, few, others);
  const bool mixed = detail::has_step(found, few, detail::left_of_step_at_5);
  MeanLight result{Color{0.0}, mixed, std::vector<double>(many.size(), 0.0)};
  constexpr double little = 0.02;  // relative to the light of all lamps
  for (std::size_t k = 0; k < region.size(); ++k) {
    if (!mixed || !(found.lamps[k].difference > little * found.most)) {
      result.direct += found.lamps[k].mean;
      for (double& light : result.light) { light += sum_of_channels(found.lamps[k].mean); }
      continue;
    }
    Color mean{0.0};
    for (std::size_t i = 0; i < many.size(); ++i) {
      const Color light = detail::light_of(region, k, many[i].place, others + result.direct);
      mean += light / static_cast<double>(many.size());
      result.light[i] += sum_of_channels(light);
    }
    result.direct += mean;
  }
  return result;
}

}  // namespace radiosity
