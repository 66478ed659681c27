// SPDX-License-Identifier: MIT
#include <radiosity/camera/shadow_edges.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <raycast/inline.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::optional<Color> over_pixel(LitRegion& region, const FinalGather::Place& own, std::span<const FinalGather::Place> few,
                                                 std::span<const FinalGather::Place> many) {
  if (few.empty() || many.empty()) { return std::nullopt; }
  const auto light = [&](std::size_t lamp, const FinalGather::Place& place, const Color& others) {
    return region.lamp(lamp).exitance * region.form_factor(lamp, place.point.position, place.point.normal, others);
  };
  const auto sum = [](const Color& c) { return c.x + c.y + c.z; };
  const auto difference = [](std::span<const double> values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return *most - *least;
  };
  struct OfLamp {
    Color mean{0.0};
    double difference = 0.0;
  };
  std::vector<OfLamp> lamps(region.size());
  // Irradiance by this lamp and by all so far, at `few` and `own`, summed over the channels.
  std::vector<double> of_lamp(few.size() + 1), of_all(few.size() + 1);
  std::vector<Color> so_far(few.size() + 1, Color{0.0});
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    for (std::size_t i = 0; i <= few.size(); ++i) {
      const Color l = light(k, i < few.size() ? few[i] : own, so_far[i]);
      of_lamp[i] = sum(l);
      so_far[i] += l;
      if (i < few.size()) { lamps[k].mean += l / static_cast<double>(few.size()); }
    }
    lamps[k].difference = difference(of_lamp);
  }
  std::transform(so_far.begin(), so_far.end(), of_all.begin(), sum);
  const double most = *std::max_element(of_all.begin(), of_all.end());
  const bool differ = difference(of_all) > change_at_edge * most;
  constexpr double little = 0.02;  // relative to the light of all lamps
  Color all{0.0};
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    if (differ && lamps[k].difference > little * most) {
      lamps[k].mean = Color{0.0};
      for (const FinalGather::Place& place : many) { lamps[k].mean += light(k, place, all) / static_cast<double>(many.size()); }
    }
    all += lamps[k].mean;
  }
  return all;
}

}  // namespace radiosity
