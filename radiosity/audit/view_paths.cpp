// SPDX-License-Identifier: MIT
#include <radiosity/audit/view_paths.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

// The first front face on a ray from the eye that is not buried.
[[nodiscard]] HALFLIGHT_INLINE std::optional<raycast::ScenePoint> seen_from(const raycast::Scene& objects, const glm::dvec3& eye,
                                                                            const glm::dvec3& direction) {
  constexpr int most = 64;  // limit of back faces passed
  raycast::Segment ray{eye, direction * (glm::length(eye) + objects.diameter())};
  std::uint32_t owner = raycast::no_object, sheet = 0;
  for (int passed = 0; passed < most; ++passed) {
    const auto hit = objects.closest(ray, owner, sheet);
    if (!hit) { return std::nullopt; }
    const raycast::ScenePoint at = objects.point(*hit, ray);
    if (hit->front && !objects.covered(at)) { return at; }
    ray = {ray.at(hit->t), ray.direction};
    owner = hit->object;
    sheet = hit->sheet;
  }
  return std::nullopt;
}

// The points of one path, its share of the picture, and share times the squared reflected radiosity of its first point.
struct ViewPath {
  std::vector<ImportantPoint> points;
  double share = 0.0, square = 0.0;
};

[[nodiscard]] HALFLIGHT_INLINE ViewPath view_path(const DiscreteScene& scene, const PathTracer& tracer, const Viewpoint& from,
                                                  const glm::dvec3& eye, Random random) {
  constexpr int bounces = 3;
  ViewPath path;
  const double z = 1.0 - 2.0 * random.uniform(), turn = 2.0 * std::numbers::pi * random.uniform();
  const double side = std::sqrt(std::max(0.0, 1.0 - z * z));
  const glm::dvec3 direction{side * std::cos(turn), side * std::sin(turn), z};
  std::optional<raycast::ScenePoint> at = seen_from(scene.objects, eye, direction);
  if (!at) { return path; }
  const glm::dvec3 d = at->position - eye;
  const double cosine = -glm::dot(direction, at->normal);
  if (!(cosine > 0.0)) { return path; }
  // The share of the picture per unit of solid angle, independent of the scene's size.
  path.share = from.share(scene.frame.to_scene(at->position), at->normal) * glm::dot(d, d) / cosine;
  if (!(path.share > 0.0)) { return path; }
  const Material& seen = tracer.of(*at);
  if (is_black(seen.reflectance)) { return {}; }
  Color square{1.0};
  for (int k = 0; k < 2; ++k) {  // two independent estimates: the noise of their product cancels on average
    std::uint64_t rays = 0;
    square *= tracer.radiosity(*at, random, rays, bounces).all - seen.emission;
  }
  path.square = path.share * brightest(square);
  path.points.push_back({tracer.surface(at->object, at->sheet), *at, path.share});
  double carried = path.share;
  for (int k = 0; k < bounces; ++k) {
    carried *= brightest(tracer.of(*at).reflectance);
    const double u = random.uniform();
    const raycast::Segment ray{at->position, cosine_direction(at->normal, u, random.uniform()) * scene.objects.diameter()};
    const auto hit = scene.objects.closest(*at, ray.direction);
    if (!hit || !hit->front || !(carried > 0.0)) { break; }
    at = scene.objects.point(*hit, ray);
    path.points.push_back({tracer.surface(at->object, at->sheet), *at, carried});
  }
  return path;
}

}  // namespace detail

HALFLIGHT_INLINE ViewPaths view_paths(const DiscreteScene& scene, const PathTracer& tracer, const Viewpoint& from) {
  // Most: rays from the eye; enough: rays that hit something in the picture.
  constexpr std::size_t batch = 2048, most = 32 * batch, enough = 1024;
  const glm::dvec3 eye = (from.eye - scene.frame.centre) * scene.frame.scale;
  std::vector<ImportantPoint> seen, lights_it;
  double share = 0.0, square = 0.0;
  std::vector<detail::ViewPath> paths(batch);
  for (std::size_t first = 0; first < most && seen.size() < enough && !scene.control.cancelled(); first += batch) {
    parallel_for(
        batch, scene.threads,
        [&](std::size_t i) {
          paths[i] = detail::view_path(scene, tracer, from, eye, Random{scene.seed, first + i, 0x7669657770617468ull});
        },
        16);
    for (const detail::ViewPath& path : paths) {
      if (path.points.empty()) { continue; }
      share += path.share;
      square += path.square;
      seen.push_back(path.points.front());
      lights_it.insert(lights_it.end(), path.points.begin() + 1, path.points.end());
    }
  }
  ViewPaths result;
  if (share > 0.0) { result.reflected = std::sqrt(std::max(0.0, square / share)); }
  for (const std::vector<ImportantPoint>* const half : {&seen, &lights_it}) {
    double total = 0.0;
    for (const ImportantPoint& point : *half) { total += point.weight; }
    for (const ImportantPoint& point : *half) { result.points.push_back({point.surface, point.at, 0.5 * point.weight / total}); }
  }
  return result;
}

}  // namespace radiosity
