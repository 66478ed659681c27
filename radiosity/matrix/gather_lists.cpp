// SPDX-License-Identifier: MIT
#include <radiosity/matrix/gather_lists.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/leaf_locator.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

[[nodiscard]] inline std::uint32_t sheet_of(const DiscreteScene& scene, std::uint32_t leaf) {
  const Node& node = scene.hierarchy[leaf];
  return node.surface - scene.surfaces[node.object].first_surface;
}

// A point of the exposed part of a leaf, projected onto the true surface.
[[nodiscard]] HALFLIGHT_INLINE raycast::SurfacePoint point_on(const DiscreteScene& scene, std::uint32_t leaf, double u, double v,
                                                              Random& random) {
  const Patch& patch = scene.patches[leaf];
  const ExposedPoints* exposed = scene.exposure.points(leaf);
  const auto block = static_cast<std::uint32_t>(u * 4.0) + 4 * static_cast<std::uint32_t>(v * 4.0);
  const glm::dvec3 x = exposed != nullptr ? exposed->draw(patch, block, random) : sample(patch, u, v);
  const raycast::PlacedObject& object = scene.objects.object(scene.hierarchy[leaf].object);
  return object.flat() ? raycast::SurfacePoint{x, patch.normal} : object.project(sheet_of(scene, leaf), x);
}

// The leaves that emit, with their cumulative power.
struct ListLamps {
  explicit ListLamps(const DiscreteScene& scene) {
    double area = 0.0, total = 0.0;
    for (std::uint32_t i = 0; i < scene.hierarchy.size(); ++i) {
      const Node& node = scene.hierarchy[i];
      if (!node.leaf() || !(scene.exposure.area[i] > 0.0)) { continue; }
      total += scene.exposure.area[i];
      const Color& e = scene.emission[node.surface];
      if (is_black(e)) { continue; }
      area += scene.exposure.area[i];
      power += scene.exposure.area[i] * sum_of_channels(e);
      leaves.push_back(i);
      up_to.push_back(power);
    }
    if (area > 0.1 * total) { leaves.clear(); }
  }

  std::vector<std::uint32_t> leaves;  // empty: the lists carry their light
  std::vector<double> up_to;
  double power = 0.0;
};

// Irradiance from the lamps: the mean over `count` points of the leaf, each paired with a point of a lamp.
HALFLIGHT_INLINE Color light_of_lamps(const DiscreteScene& scene, const ListLamps& lamps, std::uint32_t leaf, std::uint32_t count) {
  const Sobol4 sequence{scene.seed, leaf};
  Random random{scene.seed, leaf, 0x6c616d7073ull};
  const std::uint32_t object = scene.hierarchy[leaf].object, sheet = sheet_of(scene, leaf);
  Color sum{0.0};
  for (std::uint32_t first = 0; first < count; first += 16) {
    raycast::Segments16 segments;
    std::array<Color, 16> carries{};
    for (std::uint32_t k = 0; k < 16; ++k) {
      std::array<double, 4> u = sequence(first + k);
      // One coordinate chooses the lamp; its position within the lamp's share is reused as a coordinate on the lamp.
      const double at = u[2] * lamps.power;
      const std::size_t l = drawn_index(lamps.up_to, at);
      const double before = l > 0 ? lamps.up_to[l - 1] : 0.0, own = lamps.up_to[l] - before;
      const std::uint32_t lamp = lamps.leaves[l];
      const raycast::SurfacePoint x = point_on(scene, leaf, u[0], u[1], random);
      const raycast::SurfacePoint y = point_on(scene, lamp, std::clamp((at - before) / own, 0.0, 1.0 - 0x1p-30), u[3], random);
      const glm::dvec3 d = y.position - x.position;
      const double r2 = glm::dot(d, d), cosines = std::max(0.0, glm::dot(d, x.normal)) * std::max(0.0, -glm::dot(d, y.normal));
      if (!(cosines > 0.0)) { continue; }
      const double density = own / (lamps.power * scene.exposure.area[lamp]);
      carries[k] = scene.emission[scene.hierarchy[lamp].surface] * (cosines / (std::numbers::pi * r2 * r2 * density));
      segments.set(k, {x.position, d}, object, scene.hierarchy[lamp].object, sheet, sheet_of(scene, lamp));
    }
    const std::uint32_t blocked = segments.lanes != 0 ? scene.objects.occluded16(segments) : 0;
    for (std::uint32_t k = 0; k < 16; ++k) { sum += (blocked >> k & 1u) != 0 ? Color{0.0} : carries[k]; }
  }
  return sum / static_cast<double>(count);
}

// Number of points or rays of a leaf, in proportion to the square root of its area.
[[nodiscard]] inline std::uint32_t share_of(std::uint32_t of_largest, std::uint32_t least, double area, double largest) {
  return std::max(least, static_cast<std::uint32_t>(of_largest * std::sqrt(area / largest)));
}

// The lamps' light reflected by each leaf, or the leaf's emission if the lists carry the light of lamps.
HALFLIGHT_INLINE std::vector<Color> first_light(const DiscreteScene& scene, const ListLamps& lamps,
                                                const std::vector<std::uint32_t>& points, RayCount& rays) {
  std::vector<Color> light(scene.hierarchy.size(), Color{0.0});
  parallel_for(
      light.size(), scene.threads,
      [&](std::size_t i) {
        const std::uint32_t surface = scene.hierarchy[i].surface;
        if (points[i] == 0 || scene.control.cancelled()) { return; }
        light[i] = lamps.leaves.empty()
                       ? scene.emission[surface]
                       : scene.reflectance[surface] * light_of_lamps(scene, lamps, static_cast<std::uint32_t>(i), points[i]);
      },
      16);
  if (!lamps.leaves.empty()) {
    for (const std::uint32_t n : points) { rays.cast += n; }
  }
  return light;
}

// The leaves that the rays met, ray by ray; 4 bytes a ray instead of 36.
struct MetLeaves {
  explicit MetLeaves(const StoredRays& rays, std::size_t nodes) {
    to.reserve(rays.size());
    for (std::size_t i = 0; i < nodes; ++i) {
      for (const StoredRay& ray : rays.of(i)) { to.push_back(ray.to); }
      end.push_back(to.size());
    }
  }
  std::vector<std::uint32_t> to;  // no_node: nothing that reflects
  std::vector<std::size_t> end;   // end of the rays of each node
};

// Iterates radiosity = first + reflected radiosity until it converges.
HALFLIGHT_INLINE void gather(const DiscreteScene& scene, const MetLeaves& met, const std::vector<Color>& first, double wanted,
                             std::uint32_t max_iterations, DenseSolution& solution) {
  std::vector<Color> next(first.size(), Color{0.0});
  double emitted = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) { emitted += scene.exposure.area[i] * glm::dot(first[i], first[i]); }
  solution.radiosity = first;
  for (;; ++solution.iterations) {
    double square = 0.0;
    for (std::size_t i = 0, k = 0; i < first.size(); ++i) {
      const std::size_t begin = k;
      Color sum{0.0};
      for (; k < met.end[i]; ++k) { sum += met.to[k] != no_node ? solution.radiosity[met.to[k]] : Color{0.0}; }
      next[i] = first[i];
      if (k > begin) { next[i] += scene.reflectance[scene.hierarchy[i].surface] * sum / static_cast<double>(k - begin); }
      const Color change = next[i] - solution.radiosity[i];
      square += scene.exposure.area[i] * glm::dot(change, change);
    }
    solution.residual = emitted > 0.0 ? std::sqrt(square / emitted) : 0.0;
    solution.converged = solution.residual <= wanted;
    solution.cancelled = scene.control.cancelled();
    if (solution.converged || solution.cancelled || solution.iterations == max_iterations) { return; }
    std::swap(solution.radiosity, next);
  }
}

}  // namespace detail

HALFLIGHT_INLINE DenseSolution gather_by_lists(const DiscreteScene& scene, const ListEffort& effort, double wanted,
                                               std::uint32_t max_iterations) {
  const std::size_t n = scene.hierarchy.size();
  DenseSolution solution;
  std::vector<std::uint32_t> points(n, 0), rays(n, 0);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) { largest = std::max(largest, scene.hierarchy[i].leaf() ? scene.exposure.area[i] : 0.0); }
  for (std::size_t i = 0; i < n; ++i) {
    const double area = scene.exposure.area[i];
    if (!scene.hierarchy[i].leaf() || !(area > 0.0)) { continue; }
    points[i] = (detail::share_of(effort.lamp_points, 16, area, largest) + 15) / 16 * 16;
    rays[i] = is_black(scene.reflectance[scene.hierarchy[i].surface]) ? 0 : detail::share_of(effort.rays, 4, area, largest);
  }
  const detail::ListLamps lamps{scene};
  const std::vector<Color> first = detail::first_light(scene, lamps, points, solution.rays);
  const StoredRays cast = cast_rays(scene, LeafLocator{scene.hierarchy, scene.patches, scene.inputs.size()}, rays);
  solution.rays.cast += cast.size();
  solution.exchanges = cast.size();
  const detail::MetLeaves met{cast, n};
  detail::gather(scene, met, first, wanted, max_iterations, solution);
  if (!lamps.leaves.empty()) {
    for (const std::uint32_t lamp : lamps.leaves) { solution.radiosity[lamp] += scene.emission[scene.hierarchy[lamp].surface]; }
  }
  return solution;
}

}  // namespace radiosity
