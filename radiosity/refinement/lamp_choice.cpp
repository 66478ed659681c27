// SPDX-License-Identifier: MIT
#include <radiosity/refinement/lamp_choice.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::vector<bool> choose_lamps(const DiscreteScene& scene) {
  double area = 0.0;
  double power = 0.0;
  for (std::size_t i = 0; i < scene.hierarchy.size(); ++i) {
    if (!is_input_face(scene.hierarchy, i)) { continue; }
    area += scene.hierarchy[i].area;
    power += scene.hierarchy[i].area * brightest(scene.emission[scene.hierarchy[i].surface]);
  }
  area = std::max(area, 2.0 * scene.objects.bounds().half_area());
  std::vector<bool> lamps;
  for (const Color& emission : scene.emission) { lamps.push_back(brightest(emission) * area > least_lamp_contrast * power); }
  return lamps;
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
