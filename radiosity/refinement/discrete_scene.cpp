// SPDX-License-Identifier: MIT
#include <radiosity/refinement/discrete_scene.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/prepare.hpp>

namespace radiosity {

HALFLIGHT_INLINE DiscreteScene::DiscreteScene(const Scene& scene, unsigned thread_limit, std::uint64_t random_seed,
                                              const Control& controlled_by, const MemoryBudget& within)
    : input{scene},
      threads{thread_limit},
      seed{random_seed},
      control{controlled_by},
      budget{within},
      objects{std::vector<raycast::PlacedObject>{}},
      hierarchy(within.arrays),
      patches{surfaces, hierarchy, within.arrays},
      evaluator{view(), exposure, shown, seed} {}

HALFLIGHT_INLINE void DiscreteScene::take(Prepared prepared) {
  frame = prepared.frame;
  objects = std::move(prepared.objects);
  surfaces = std::move(prepared.surfaces);
  plan = std::move(prepared.plan);
  inputs = radiosity::surfaces(input);
  for (const InputSurface& surface : inputs) {
    const Material& material = input.materials[surface.material];
    materials.push_back(surface.material);
    reflectance.push_back(material.reflectance);
    emission.push_back(material.emission);
    lamps.push_back(!is_black(material.emission));
  }
}

HALFLIGHT_INLINE void DiscreteScene::expose() {
  patches.extend(threads);
  extend(exposure, view(), threads, seed);
}

HALFLIGHT_INLINE ShownAreas DiscreteScene::exposed_shown() const {
  return ShownAreas{hierarchy, [&](std::size_t i) { return exposure.area[i]; }};
}

HALFLIGHT_INLINE bool DiscreteScene::loses_nothing(const PartsWithoutLoss& parts, std::size_t i) const {
  if (hierarchy[i].is_cluster() || parts.all.empty()) { return false; }
  std::size_t listed = i;
  while (listed >= parts.all.size()) { listed = hierarchy[listed].parent; }
  if (parts.all[listed] || parts.but_backs.empty() || !parts.but_backs[listed]) { return parts.all[listed]; }
  const Patch& patch = patches[i];
  // A curved surface may bulge by as much as the patch is wide.
  const double least = objects.object(hierarchy[i].object).flat() ? -1e-9 * objects.diameter() : 2.0 * patch.radius;
  return std::all_of(parts.backs.begin(), parts.backs.end(), [&](const raycast::ScenePoint& back) {
    return std::all_of(patch.contour.begin(), patch.contour.end(),
                       [&](const glm::dvec3& p) { return glm::dot(p - back.position, back.normal) >= least; });
  });
}

HALFLIGHT_INLINE std::uint64_t DiscreteScene::bytes() const {
  std::uint64_t sum = objects.bytes();
  for (const Surface& surface : surfaces) { sum += surface.brep.bytes(); }
  return sum;
}

}  // namespace radiosity
