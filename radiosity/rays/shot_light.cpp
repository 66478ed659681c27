// SPDX-License-Identifier: MIT
#include <radiosity/rays/shot_light.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/object.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/visibility/leaf_locator.hpp>

namespace radiosity {

HALFLIGHT_INLINE ShotLight::ShotLight(const DiscreteScene& scene, const LeafLocator& locator, const std::vector<double>& brightness) {
  constexpr double rays = 4096.0;
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  const auto power = [&](std::size_t i) { return hierarchy[i].leaf() && area[i] > 0.0 ? area[i] * brightness[i] : 0.0; };
  double total = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) { total += power(i); }
  density_.assign(hierarchy.size(), 0.0);
  if (!(total > 0.0)) { return; }
  std::vector<std::uint32_t> counts(hierarchy.size(), 0);
  double until = 0.5;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    const double before = std::floor(until);
    until += rays * power(i) / total;
    counts[i] = static_cast<std::uint32_t>(std::floor(until) - before);
    density_[i] = counts[i] > 0 ? static_cast<double>(counts[i]) / area[i] : 0.0;
  }
  const StoredRays cast = cast_rays(scene, locator, counts, RayUse::shots);
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    for (const StoredRay& ray : cast.of(i)) {
      if (ray.to == no_node) { continue; }
      const Node& met = hierarchy[ray.to];
      rays_.push_back({i, met.surface, static_cast<double>(ray.length), {met.centre + glm::dvec3{ray.end}, met.normal}});
    }
  }
}

HALFLIGHT_INLINE double ShotLight::density(const Hierarchy& hierarchy, std::uint32_t node) const {
  while (node != no_node && node >= density_.size()) { node = hierarchy[node].parent; }
  return node != no_node ? density_[node] : 0.0;
}

HALFLIGHT_INLINE std::vector<ShotLight::Ray> ShotLight::on(const Hierarchy& hierarchy, const LeafLocator& locator,
                                                           const std::vector<bool>& open) const {
  std::vector<Ray> result;
  for (const Landed& ray : rays_) {
    std::uint32_t node = locator(ray.surface, ray.at);
    while (node != no_node && !open[node]) { node = hierarchy[node].parent; }
    if (node != no_node) { result.push_back({ray.from, node, ray.length}); }
  }
  return result;
}

}  // namespace radiosity
