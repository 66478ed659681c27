// SPDX-License-Identifier: MIT
#include <radiosity/rays/spacing.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <raycast/inline.hpp>

#include <radiosity/hierarchy/buried.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/rays/leaf_locator.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

HALFLIGHT_INLINE SpacingResult split_by_distance(DiscreteScene& scene, double tolerance, double min_area) {
  SpacingResult result;
  Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<bool> buried = buried_nodes(scene.surfaces, hierarchy);  // of the input faces
  double all = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { all += is_input_face(hierarchy, i) && !buried[i] ? hierarchy[i].area : 0.0; }
  for (std::size_t first_new = 0; first_new < hierarchy.size();) {
    const std::size_t end = hierarchy.size();
    const auto wants = [&](std::size_t i, double nearness) {
      return hierarchy[i].radius * nearness * std::sqrt(hierarchy[i].area / all) > tolerance;
    };
    scene.patches.extend(scene.threads);
    std::vector<std::uint32_t> counts(end, 0);
    for (std::size_t i = first_new; i < end; ++i) {
      const Node& node = hierarchy[i];
      const bool shows = i >= buried.size() || !buried[i];
      counts[i] = shows && node.leaf() && is_black(scene.emission[node.surface]) && node.area > min_area * all ? 16 : 0;
    }
    const StoredRays rays = cast_rays(scene, LeafLocator{hierarchy, scene.patches, scene.inputs.size()}, counts);
    result.rays += rays.size();
    result.cancelled = scene.control.cancelled();
    if (result.cancelled) { return result; }
    std::vector<std::uint32_t> split;
    std::uint64_t nodes = end;
    for (std::uint32_t i = static_cast<std::uint32_t>(first_new); i < end; ++i) {
      if (counts[i] == 0 || !wants(i, rays.nearness(i, 0.1 * hierarchy[i].radius))) { continue; }
      split.push_back(i);
      nodes += hierarchy[i].corners;
    }
    if (!scene.budget.allows({nodes})) {
      result.too_large = scene.budget.peak({nodes});
      return result;
    }
    for (const std::uint32_t i : split) { static_cast<void>(subdivide(scene.surfaces, hierarchy, i, scene.meshing)); }
    first_new = end;
    ++result.generations;
    if (scene.control.after_generation) { scene.control.after_generation(scene.surfaces); }
  }
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (hierarchy[i].leaf() && is_black(scene.emission[hierarchy[i].surface])) { result.spaced.push_back(i); }
  }
  return result;
}

}  // namespace radiosity
