// SPDX-License-Identifier: MIT
#include <radiosity/picture/mesh_error.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/object.hpp>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/viewpoint.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

// The triangles of a mesh that reflect light, for drawing points: half of them uniformly by area, half by the squared reflected light.
// Where only a picture counts, areas are those in the picture.
struct ReflectingTriangles {
  struct Triangle {
    std::uint32_t surface;
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};  // in the frame
    double share;                       // estimated share of the picture per area
    double area;                        // times `share`
    double light;                       // squared reflected light
    double until;                       // cumulative share of the points
  };

  ReflectingTriangles(const FinalGather& light, const Mesh& mesh, const std::optional<Viewpoint>& viewpoint);
  [[nodiscard]] double density(const Triangle& t) const {
    return all_light > 0.0 ? 0.5 / all_area + 0.5 * t.light / all_light : 1.0 / all_area;
  }

  std::vector<Triangle> triangles;
  double all_area = 0.0, all_light = 0.0;
};

HALFLIGHT_INLINE ReflectingTriangles::ReflectingTriangles(const FinalGather& light, const Mesh& mesh,
                                                          const std::optional<Viewpoint>& viewpoint) {
  for (const MeshFace& face : mesh.faces) {
    const auto corner = [&](std::uint32_t k) {
      return (mesh.positions[mesh.corners[face.first_corner + k].vertex] - light.frame().centre) * light.frame().scale;
    };
    const Material& material = light.material(face.surface);
    if (is_black(material.reflectance)) { continue; }
    const Color reflected = face.radiosity - material.emission;
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      Triangle t{face.surface, corner(0), corner(k), corner(k + 1), 1.0, 0.0, glm::dot(reflected, reflected), 0.0};
      const glm::dvec3 doubled = glm::cross(t.b - t.a, t.c - t.a);
      t.area = 0.5 * glm::length(doubled);
      if (viewpoint && t.area > 0.0) {  // upper estimate of its share of the picture
        t.share = 0.0;
        for (const glm::dvec3& p : {t.a, t.b, t.c, (t.a + t.b + t.c) / 3.0}) {
          t.share = std::max(t.share, viewpoint->share(light.frame().to_scene(p), doubled / (2.0 * t.area)));
        }
        t.area *= t.share;
      }
      all_area += t.area;
      all_light += t.area * t.light;
      triangles.push_back(t);
    }
  }
  double before = 0.0;
  for (Triangle& t : triangles) { before = t.until = before + t.area * density(t); }
}

}  // namespace detail

HALFLIGHT_INLINE MeshErrorMeter::MeshErrorMeter(const DiscreteScene& scene, const FinalGather& light, const Mesh& mesh,
                                                std::uint64_t points)
    : scene_{&scene}, light_{&light} {
  const Control& control = scene.control;
  const detail::ReflectingTriangles from{light, mesh, control.viewpoint};
  if (!(from.all_area > 0.0)) { return; }
  std::vector<Sample> samples(points);
  const auto measure = [&](std::size_t i) {
    Random random{scene.seed, i, 0x6d657368ull};
    const auto& t = drawn(from.triangles, (static_cast<double>(i) + random.uniform()) / static_cast<double>(points));
    const double u = random.uniform();
    const glm::dvec3 chord = triangle_point(triangle_weights(u, random.uniform()), t.a, t.b, t.c);
    const InputSurface& input = scene.inputs[t.surface];
    Sample& sample = samples[i];
    sample.place = {light.objects().object(input.object).project(input.sheet, chord), input.object, t.surface};
    if (light.objects().covered(sample.place.point.position, sample.place.point.normal, input.object)) { return; }
    sample.weight = 1.0 / (from.all_area * from.density(t));
    if (control.viewpoint) {
      sample.weight *= seen_share(control.viewpoint, light, sample.place) / t.share;
      if (!(sample.weight > 0.0)) { return; }
    }
    const Material& material = light.material(t.surface);
    LitRegion region = light.lit_region(std::span(&sample.place, 1));
    const Color direct = region.irradiance(sample.place.point.position, sample.place.point.normal);
    for (std::uint64_t half = 0; half < 2; ++half) {
      constexpr std::uint32_t rays = 512;  // of each half; enough that their noise is smaller than that of the choice of points
      const auto indirect = light.indirect(sample.place, {rays, rays, 0.0}, random.bits());
      sample.light[half] = material.emission + material.reflectance * (direct + indirect.irradiance);
    }
  };
  const auto report = [&](std::size_t done) { control.report("mesh audit", static_cast<double>(done) / static_cast<double>(points)); };
  if (!parallel_in_batches(control, scene.threads, points, {512, 4}, measure, report)) { return; }
  samples_ = std::move(samples);
  area_ = from.all_area;
}

HALFLIGHT_INLINE double MeshErrorMeter::square() const {
  double sum = 0.0;
  for (const Sample& sample : samples_) {
    const Color emission = sample.weight > 0.0 ? light_->material(sample.place.surface).emission : Color{0.0};
    sum += sample.weight * glm::dot(sample.light[0] - emission, sample.light[1] - emission);
  }
  return samples_.empty() ? 0.0 : std::max(0.0, sum * area_ / static_cast<double>(samples_.size()));
}

HALFLIGHT_INLINE std::optional<ErrorEstimate> MeshErrorMeter::measure(const Mesh& mesh) const {
  const Lookup lookup{scene_->input, mesh, light_->frame()};
  ErrorSums sums;
  for (const Sample& sample : samples_) {
    if (!(sample.weight > 0.0)) { continue; }
    const std::uint32_t sheet = sample.place.surface - lookup.surface(sample.place.object, 0);
    const std::optional<Color> shown = lookup.at({sample.place.point, sample.place.object, sheet});
    if (!shown) { continue; }
    const Color& emission = light_->material(sample.place.surface).emission;
    const auto& [a, b] = sample.light;
    const double half_square = 0.5 * glm::dot(a - b, a - b);
    sums.add(sample.weight * glm::dot(a - *shown, b - *shown), sample.weight * glm::dot(a - emission, b - emission),
             sample.weight * sample.weight * half_square * half_square / 3.0);
  }
  return sums.estimate();
}

}  // namespace radiosity
