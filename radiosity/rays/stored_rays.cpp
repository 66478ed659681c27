// SPDX-License-Identifier: MIT
#include <radiosity/rays/stored_rays.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/leaf_locator.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

HALFLIGHT_INLINE StoredRays::StoredRays(const std::vector<std::uint32_t>& counts, std::pmr::memory_resource* arrays)
    : first_(counts.size() + 1, 0), rays_(arrays) {
  for (std::size_t i = 0; i < counts.size(); ++i) { first_[i + 1] = first_[i] + counts[i]; }
  rays_.resize(first_.back());
}

HALFLIGHT_INLINE double StoredRays::nearness(std::size_t node, double shortest) const {
  double sum = 0.0;
  double cast = 0.0;
  for (const StoredRay& ray : of(node)) {
    cast += ray.length >= 0.0f ? 1.0 : 0.0;
    sum += ray.length > 0.0f ? 1.0 / std::max(shortest, static_cast<double>(ray.length)) : 0.0;
  }
  return cast > 0.0 ? sum / cast : 0.0;
}

namespace detail {

// A key for each node by its position in the hierarchy, independent of the order of splits, so that the rays of a leaf depend on the leaf
// and their use alone.
[[nodiscard]] HALFLIGHT_INLINE std::vector<std::uint64_t> keys_of(const Hierarchy& hierarchy, RayUse use) {
  std::vector<std::uint64_t> keys(hierarchy.size(), 0);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {  // parents before children
    const Node& node = hierarchy[i];
    if (is_input_face(hierarchy, i)) { keys[i] = scramble(i | static_cast<std::uint64_t>(use) << 32); }
    for (std::uint32_t k = 0; k < node.child_count && !node.is_cluster(); ++k) { keys[node.first_child + k] = scramble(keys[i] + k); }
  }
  return keys;
}

// Draws the start points of rays on one node.
struct RayOrigins {
  RayOrigins(const DiscreteScene& of, std::uint32_t start, std::uint64_t key)
      : scene{of},
        node{start},
        object{of.objects.object(of.hierarchy[start].object)},
        sheet{of.hierarchy[start].surface - of.surfaces[of.hierarchy[start].object].first_surface},
        numbers{of.seed, key, 0x72617973ull} {}

  // The start of a ray and the normal there; u: a point of a low-discrepancy sequence. u[0] first chooses among the leaves below, by
  // exposed area.
  [[nodiscard]] raycast::SurfacePoint start(const std::array<double, 4>& u) {
    std::uint32_t i = node;
    double across = u[0];
    while (!scene.hierarchy[i].leaf()) { i = child_for(i, across); }
    const Patch& patch = scene.patches[i];
    const auto cell = static_cast<std::uint32_t>(u[1] * 4.0) * 4 + static_cast<std::uint32_t>(across * 4.0);
    const ExposedPoints* exposed = i < scene.exposure.area.size() ? scene.exposure.points(i) : nullptr;
    const glm::dvec3 x = exposed != nullptr ? exposed->draw(patch, cell, numbers) : sample(patch, across, u[1]);
    return object.flat() ? raycast::SurfacePoint{x, patch.normal} : object.project(sheet, x);
  }

  // The child within whose share of the exposed area u lies; u is rescaled to its position within that share.
  [[nodiscard]] std::uint32_t child_for(std::uint32_t i, double& u) const {
    const Node& parent = scene.hierarchy[i];
    double left = u * scene.exposure.area[i];
    std::uint32_t c = parent.first_child;
    for (const std::uint32_t last = c + parent.child_count - 1; c < last && left >= scene.exposure.area[c]; ++c) {
      left -= scene.exposure.area[c];
    }
    u = std::clamp(left / scene.exposure.area[c], 0.0, 1.0 - 1e-12);
    return c;
  }

  const DiscreteScene& scene;
  std::uint32_t node;
  const raycast::PlacedObject& object;
  std::uint32_t sheet;
  Random numbers;  // for leaves that are partly buried
};

// `key`: of the node.
HALFLIGHT_INLINE void cast_from(const DiscreteScene& scene, const LeafLocator& locator, std::uint32_t node, std::uint64_t key,
                                std::span<StoredRay> rays) {
  RayOrigins origins{scene, node, key};
  const Sobol4 sequence{scene.seed, key};
  const double reach = scene.objects.diameter();
  const glm::dvec3 centre = scene.hierarchy[node].centre;
  const std::uint32_t object = scene.hierarchy[node].object;
  const bool exposure_known = node < scene.exposure.area.size();
  for (std::size_t first = 0; first < rays.size(); first += 16) {
    raycast::Segments16 segments;
    const auto count = static_cast<unsigned>(std::min<std::size_t>(16, rays.size() - first));
    for (unsigned k = 0; k < count; ++k) {
      const std::array<double, 4> u = sequence(static_cast<std::uint32_t>(first) + k);
      const raycast::SurfacePoint start = origins.start(u);
      rays[first + k].start = start.position - centre;
      if (!exposure_known && scene.objects.covered(start.position, start.normal, object)) {
        rays[first + k].length = -1.0f;
        continue;
      }
      segments.set(k, {start.position, reach * cosine_direction(start.normal, u[2], u[3])}, object, raycast::no_object, origins.sheet);
    }
    const raycast::Hits16 hits = scene.objects.closest16(segments);
    for (std::uint32_t rest = hits.met; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(rest));
      const raycast::Hit& hit = hits.hit[k];
      StoredRay& ray = rays[first + k];
      ray.length = static_cast<float>(hit.t * reach);
      if (!hit.front) { continue; }
      const raycast::PlacedObject& met = scene.objects.object(hit.object);
      raycast::SurfacePoint end{segments.at(k).at(hit.t), glm::dvec3{0.0}};
      if (!met.flat()) { end = met.project(hit.sheet, end.position); }
      ray.to = locator(scene.surfaces[hit.object].first_surface + hit.sheet, end);
      if (ray.to != no_node) { ray.end = end.position - scene.hierarchy[ray.to].centre; }
    }
  }
}

}  // namespace detail

HALFLIGHT_INLINE StoredRays cast_rays(const DiscreteScene& scene, const LeafLocator& locator, const std::vector<std::uint32_t>& counts,
                                      RayUse use) {
  StoredRays rays{counts, scene.budget.arrays};
  const std::vector<std::uint64_t> keys = detail::keys_of(scene.hierarchy, use);
  parallel_in_batches(scene.control, scene.threads, counts.size(), {1 << 12, 16}, [&](std::size_t i) {
    if (counts[i] > 0) { detail::cast_from(scene, locator, static_cast<std::uint32_t>(i), keys[i], rays.of(i)); }
  });
  return rays;
}

}  // namespace radiosity
