// SPDX-License-Identifier: MIT
#include <radiosity/oracle/lit_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/scene_view.hpp>

namespace radiosity {

namespace detail {

// Irradiance on these faces of one surface from other emitters, by cosine-distributed rays from their centres.
[[nodiscard]] HALFLIGHT_INLINE double light_from_others(const SceneView& scene, std::span<const Color> emission,
                                                        std::span<const std::uint32_t> faces, std::size_t rays) {
  double sum = 0.0, area = 0.0;
  for (const std::uint32_t face : faces) {
    const Node& node = scene.hierarchy[face];
    const std::uint32_t sheet = scene.sheet(face);
    const raycast::SurfacePoint from = scene.objects.object(node.object).project(sheet, node.centre);
    double light = 0.0;
    for (std::size_t k = 0; k < rays; ++k) {
      Random random{0x6c6974u, face, k};
      const double u = (static_cast<double>(k) + random.uniform()) / static_cast<double>(rays);
      const raycast::Segment ray{from.position, cosine_direction(from.normal, u, random.uniform()) * scene.objects.diameter()};
      const auto hit = scene.objects.closest(ray, node.object, sheet);
      if (hit && hit->front) { light += brightest(emission[scene.surfaces[hit->object].first_surface + hit->sheet]); }
    }
    sum += node.area * light / static_cast<double>(rays);
    area += node.area;
  }
  return area > 0.0 ? sum / area : 0.0;
}

}  // namespace detail

HALFLIGHT_INLINE LitFaces::LitFaces(const SceneView& scene, std::span<const Color> reflectance, std::span<const Color> emission,
                                    const std::vector<bool>& buried)
    : weight_(scene.hierarchy.size(), 0.0), of_surface_(emission.size(), 0.0) {
  constexpr std::size_t most_rays = 64, all_rays = 65536;
  const Hierarchy& hierarchy = scene.hierarchy;
  const auto counts = [&](std::uint32_t i) { return is_input_face(hierarchy, i) && !(i < buried.size() && buried[i]); };
  double all = 0.0;
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (!counts(i)) { continue; }
    all += hierarchy[i].area;
    power_ += hierarchy[i].area * brightest(emission[hierarchy[i].surface]);
  }
  for (std::size_t s = 0; s < emission.size(); ++s) {
    const double to_mean = power_ > 0.0 ? brightest(emission[s]) * (all / power_) : 0.0;
    of_surface_[s] = is_black(reflectance[s]) ? 0.0 : std::clamp(2.0 * (1.0 - to_mean), 0.0, 1.0);
  }
  std::vector<std::vector<std::uint32_t>> bright(emission.size());  // by surface
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (!counts(i) || is_black(reflectance[hierarchy[i].surface]) || of_surface_[hierarchy[i].surface] == 1.0) { continue; }
    bright[hierarchy[i].surface].push_back(i);
    ++count;
  }
  const std::size_t rays = std::clamp<std::size_t>(all_rays / std::max<std::size_t>(count, 1), 1, most_rays);
  for (std::size_t s = 0; s < bright.size(); ++s) {
    if (bright[s].empty()) { continue; }
    const double falls = detail::light_from_others(scene, emission, bright[s], rays);
    if (falls > 0.0) { of_surface_[s] = std::max(of_surface_[s], falls / (brightest(emission[s]) + falls)); }
  }
  double largest = 0.0;
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (counts(i)) { largest = std::max(largest, of_surface_[hierarchy[i].surface]); }
  }
  const double own = own_light * (1.0 - largest);
  for (double& weight : of_surface_) { weight = largest > 0.0 ? std::min(1.0, (weight + own) / (largest + own)) : 1.0; }
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (!counts(i)) { continue; }
    weight_[i] = of_surface_[hierarchy[i].surface];
    area_ += weight_[i] * hierarchy[i].area;
    own_power_ += weight_[i] * hierarchy[i].area * brightest(emission[hierarchy[i].surface]);
  }
}

}  // namespace radiosity
