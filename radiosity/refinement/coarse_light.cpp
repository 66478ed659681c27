// SPDX-License-Identifier: MIT
#include <radiosity/refinement/coarse_light.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

[[nodiscard]] HALFLIGHT_INLINE std::vector<double> brightest_channels(const std::vector<Color>& colors) {
  std::vector<double> values;
  values.reserve(colors.size());
  for (const Color& c : colors) { values.push_back(brightest(c)); }
  return values;
}

// Sets the values of inner nodes to area averages of the leaves.
HALFLIGHT_INLINE void average_up(const Hierarchy& hierarchy, const std::vector<double>& area, std::vector<double>& values) {
  for (std::size_t i = hierarchy.size(); i-- > 0;) {  // children before parents
    const Node& node = hierarchy[i];
    if (node.leaf()) { continue; }
    double sum = 0.0;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { sum += area[c] * values[c]; }
    values[i] = area[i] > 0.0 ? sum / area[i] : 0.0;
  }
}

}  // namespace detail

HALFLIGHT_INLINE CoarseLight coarse_light(const DiscreteScene& scene, const Links& links, std::uint32_t reflections) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  const std::vector<double> emission = detail::brightest_channels(scene.emission);
  CoarseLight light{std::vector<double>(hierarchy.size(), 0.0), detail::brightest_channels(scene.reflectance)};
  std::vector<double>& radiosity = light.radiosity;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { radiosity[i] = hierarchy[i].leaf() ? emission[hierarchy[i].surface] : 0.0; }
  std::vector<double> arrived(hierarchy.size());
  for (std::uint32_t k = 0; k < reflections; ++k) {
    detail::average_up(hierarchy, area, radiosity);
    arrived.assign(hierarchy.size(), 0.0);
    for (const Link& link : links) {
      arrived[link.p] += static_cast<double>(link.exchange) * radiosity[link.q];
      arrived[link.q] += static_cast<double>(link.exchange) * radiosity[link.p];
    }
    light.reflected_square = 0.0;
    for (std::size_t i = 0; i < hierarchy.size(); ++i) {  // parents before children; `arrived` becomes an irradiance
      const Node& node = hierarchy[i];
      arrived[i] = (area[i] > 0.0 ? arrived[i] / area[i] : 0.0) + (node.parent != no_node ? arrived[node.parent] : 0.0);
      if (!node.leaf()) { continue; }
      const double reflected = light.reflectance[node.surface] * arrived[i];
      radiosity[i] = emission[node.surface] + reflected;
      light.reflected_square += area[i] * reflected * reflected;
    }
  }
  detail::average_up(hierarchy, area, radiosity);
  return light;
}

}  // namespace radiosity
