// SPDX-License-Identifier: MIT
#include <radiosity/picture/final_gather.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

HALFLIGHT_INLINE FinalGather::FinalGather(const Scene& scene, const Mesh& mesh, const Frame& frame) : lookup_{scene, mesh, frame} {
  std::vector<Color> emission;
  for (const InputSurface& input : surfaces(scene)) {
    materials_.push_back(scene.materials[input.material]);
    emission.push_back(materials_.back().emission);
  }
  std::vector<Surface> boundaries;
  for (std::uint32_t o = 0; o < objects().size(); ++o) {
    SurfaceResult made = make_surface(objects().object(o), lookup_.surface(o, 0));
    if (!made.surface) { return; }  // no solution of this scene
    boundaries.push_back(std::move(*made.surface));
  }
  direct_ = DirectLight{objects(), boundaries, emission};
}

HALFLIGHT_INLINE FinalGather::Eye FinalGather::eye(const glm::dvec3& in_scene) const {
  Eye eye{(in_scene - frame().centre) * frame().scale, true};
  for (std::uint32_t o = 0; o < objects().size() && eye.in_air; ++o) {
    const raycast::PlacedObject& object = objects().object(o);
    if (!object.solid() || (!object.inside() && !object.bounds().contains(eye.position))) { continue; }
    raycast::Spans spans;
    object.spans({eye.position, {1.0, 0.0, 0.0}}, spans);
    for (const raycast::Span& span : spans) { eye.in_air = eye.in_air && !(span.in.t <= 0.0 && span.out.t >= 0.0); }
  }
  return eye;
}

HALFLIGHT_INLINE std::array<std::optional<FinalGather::Place>, 16> FinalGather::seen16(const Eye& eye,
                                                                                       std::span<const glm::dvec3> directions) const {
  std::array<std::optional<Place>, 16> result;
  raycast::Segments16 rays;
  for (unsigned i = 0; i < directions.size(); ++i) { rays.set(i, {eye.position, directions[i]}, raycast::no_object, raycast::no_object); }
  constexpr int most = 10'000;  // surfaces passed: only backs and buried ones are, so this ends what rounding might not
  for (int passed = 0; passed < most && rays.lanes != 0; ++passed) {
    const raycast::Hits16 hits = objects().closest16(rays);
    rays.lanes &= hits.met;
    for (std::uint32_t rest = rays.lanes; rest != 0; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      const raycast::Hit& hit = hits.hit[i];
      const raycast::Segment ray = rays.at(i);
      const raycast::SurfacePoint point = objects().object(hit.object).project(hit.sheet, ray.at(hit.t));
      const bool from_air = eye.in_air && passed == 0;
      if (hit.front && (from_air || !objects().covered(point.position, point.normal, hit.object))) {
        result[i] = Place{point, hit.object, lookup_.surface(hit.object, hit.sheet)};
        rays.lanes &= ~(1u << i);
      } else {
        rays.set(i, {point.position, ray.direction}, hit.object, raycast::no_object);
      }
    }
  }
  return result;
}

HALFLIGHT_INLINE FinalGather::Indirect FinalGather::indirect(const Place& place, std::uint32_t least, std::uint32_t most, double noise,
                                                             std::uint64_t key) const {
  const Sobol4 sequence{1, key};
  const double reach = objects().diameter();
  Indirect result;
  std::array<Color, 4> part;  // means of four parts of the rays, whose spread is their noise
  part.fill(Color{0.0});
  Color sum{0.0};
  double nearness = 0.0;
  while (result.rays < most) {
    raycast::Segments16 rays;
    for (unsigned k = 0; k < 16; ++k) {
      const std::array<double, 4> u = sequence(result.rays + k);
      rays.set(k, {place.point.position, reach * cosine_direction(place.point.normal, u[0], u[1])}, place.object, raycast::no_object);
    }
    const raycast::Hits16 hits = objects().closest16(rays);
    Color of_these{0.0};
    for (std::uint32_t rest = hits.met; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(rest));
      const raycast::Hit& hit = hits.hit[k];
      nearness += 1.0 / std::max(hit.t * reach, 1e-6);
      if (!hit.front) { continue; }
      const std::uint32_t surface = lookup_.surface(hit.object, hit.sheet);
      const Color lamp = direct_.is_lamp(surface) ? materials_[surface].emission : Color{0.0};
      if (is_black(materials_[surface].reflectance)) {
        if (is_black(lamp)) { of_these += materials_[surface].emission; }
        continue;
      }
      const raycast::SurfacePoint met = objects().object(hit.object).project(hit.sheet, rays.at(k).at(hit.t));
      if (const std::optional<Color> light = lookup_.at(hit.object, hit.sheet, met)) { of_these += *light - lamp; }
    }
    sum += of_these;
    part[result.rays / 16 % 4] += of_these;
    result.rays += 16;
    if (result.rays % 64 != 0) { continue; }
    const Color mean = sum / static_cast<double>(result.rays);
    Color variance{0.0};
    for (const Color& p : part) {
      const Color off = 4.0 * p / static_cast<double>(result.rays) - mean;
      variance += off * off / 12.0;
    }
    result.noise = std::sqrt(std::max({variance.x, variance.y, variance.z}));
    if (result.rays >= least && result.noise <= noise) { break; }
  }
  result.irradiance = sum / static_cast<double>(result.rays);
  result.nearness = nearness / static_cast<double>(result.rays);
  return result;
}

}  // namespace radiosity
