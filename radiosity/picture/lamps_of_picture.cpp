// SPDX-License-Identifier: MIT
#include <radiosity/picture/lamps_of_picture.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/inline.hpp>

#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/refinement/lamp_choice.hpp>
#include <radiosity/support/draw.hpp>

namespace radiosity {

namespace detail {

inline constexpr double large_body = 0.01;         // share of all areas: of a thousand rays from a point some ten meet it
inline constexpr std::uint32_t most_faces = 4096;  // of a body whose light is summed up face by face

// By input surface, in the frame.
[[nodiscard]] HALFLIGHT_INLINE std::vector<double> areas_of_surfaces(const Lookup& lookup, std::size_t surfaces) {
  std::vector<double> areas(surfaces, 0.0);
  for (std::uint32_t s = 0; s < surfaces; ++s) {
    for (std::uint32_t k = 0; k < lookup.triangle_count(s); ++k) {
      const auto& [a, b, c] = lookup.triangle(s, k).position;
      areas[s] += triangle_area(a, b, c);
    }
  }
  return areas;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<Color> emission_of_lamps(const Lookup& lookup, const std::vector<Color>& emission) {
  const auto shining = std::count_if(emission.begin(), emission.end(), [](const Color& e) { return !is_black(e); });
  if (static_cast<std::size_t>(shining) <= LampLimits{}.most) { return emission; }
  const raycast::Scene& objects = lookup.objects();
  const std::vector<double> areas = detail::areas_of_surfaces(lookup, emission.size());
  const std::vector<bool> bright = choose_lamps(areas, emission, objects.bounds());
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<Color> of_lamps = emission;
  for (std::uint32_t o = 0; o < objects.size(); ++o) {
    const std::uint32_t first = lookup.surface(o, 0), end = first + objects.object(o).sheet_count();
    const auto is_dim = [&](std::uint32_t s) { return !is_black(emission[s]) && !bright[s]; };
    double area = 0.0;
    std::uint32_t count = 0;
    for (std::uint32_t s = first; s < end; ++s) {
      area += is_dim(s) ? areas[s] : 0.0;
      count += is_dim(s) ? 1 : 0;
    }
    if (!(area > detail::large_body * whole) && count <= detail::most_faces) { continue; }
    for (std::uint32_t s = first; s < end; ++s) { of_lamps[s] = is_dim(s) ? Color{0.0} : of_lamps[s]; }
  }
  return of_lamps;
}

}  // namespace radiosity
