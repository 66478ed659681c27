// SPDX-License-Identifier: MIT
#include <radiosity/refinement/lamp_choice.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/box.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::vector<bool> choose_lamps(const std::vector<double>& areas, const std::vector<Color>& emission,
                                                const raycast::Box& bounds) {
  double area = 0.0, power = 0.0;
  for (std::size_t s = 0; s < areas.size(); ++s) {
    area += areas[s];
    power += areas[s] * brightest(emission[s]);
  }
  area = std::max(area, 2.0 * bounds.half_area());
  std::vector<bool> lamps;
  for (const Color& e : emission) { lamps.push_back(brightest(e) * area > least_lamp_contrast * power); }
  return lamps;
}

HALFLIGHT_INLINE std::vector<bool> choose_lamps(const DiscreteScene& scene) {
  std::vector<double> areas(scene.emission.size(), 0.0);
  for (std::size_t i = 0; i < scene.hierarchy.size(); ++i) {
    if (is_input_face(scene.hierarchy, i)) { areas[scene.hierarchy[i].surface] += scene.hierarchy[i].area; }
  }
  return choose_lamps(areas, scene.emission, scene.objects.bounds());
}

HALFLIGHT_INLINE std::vector<bool> lamp_nodes(const DiscreteScene& scene) {
  const std::vector<bool> lamps = choose_lamps(scene);
  const Hierarchy& hierarchy = scene.hierarchy;
  std::vector<bool> nodes(hierarchy.size(), false);
  for (std::size_t i = hierarchy.size(); i-- > 0;) {  // children come after their parents
    const Node& node = hierarchy[i];
    if (!node.is_cluster()) {
      nodes[i] = lamps[node.surface];
      continue;
    }
    nodes[i] = true;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { nodes[i] = nodes[i] && nodes[c]; }
  }
  return std::find(nodes.begin(), nodes.end(), true) != nodes.end() ? nodes : std::vector<bool>{};
}

}  // namespace radiosity
