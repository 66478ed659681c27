// SPDX-License-Identifier: MIT
#include <radiosity/audit/surface_error.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/audit/aimed_paths.hpp>
#include <radiosity/audit/path_estimates.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

HALFLIGHT_INLINE SurfaceErrorMeter::SurfaceErrorMeter(const DiscreteScene& scene, const PathTracer& tracer, const Mesh& mesh,
                                                      const Mesh* direct, std::uint64_t seed)
    : scene_{&scene}, tracer_{&tracer}, mesh_{&mesh}, direct_{direct}, seed_{seed} {
  const auto corner = [&](std::uint32_t c) -> const glm::dvec3& { return mesh.positions[mesh.corners[c].vertex]; };
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const MeshFace& face = mesh.faces[f];
    const Color& emission = tracer.material(face.surface).emission;
    const auto square = [&](const Color& shown) { return glm::dot(shown - emission, shown - emission); };
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const std::uint32_t a = face.first_corner;
      const double area = triangle_area(corner(a), corner(a + k), corner(a + k + 1));
      // The corners count, too: they have the light of the leaves around them, and a dark leaf beside a lit one may be wrong.
      double light = 0.5 * square(face.radiosity), contrast = 0.0;
      for (const std::uint32_t c : {a, a + k, a + k + 1}) {
        light += square(mesh.corners[c].radiosity) / 6.0;
        const Color step = mesh.corners[c].radiosity - face.radiosity;
        contrast += glm::dot(step, step) / 3.0;
      }
      triangles_.push_back({f, a + k, a + k + 1, area, light, contrast});
      total_ += area;
      light_ += area * light;
      contrast_ += area * contrast;
    }
  }
  double before = 0.0;
  for (Triangle& triangle : triangles_) { before = triangle.until = before + triangle.area * density(triangle); }
}

HALFLIGHT_INLINE glm::dvec3 SurfaceErrorMeter::outward(const Triangle& triangle) const {
  const auto corner = [&](std::uint32_t c) -> const glm::dvec3& { return mesh_->positions[mesh_->corners[c].vertex]; };
  const glm::dvec3& a = corner(mesh_->faces[triangle.face].first_corner);
  return glm::cross(corner(triangle.first) - a, corner(triangle.second) - a);
}

HALFLIGHT_INLINE bool SurfaceErrorMeter::measure(std::uint64_t points, std::uint32_t paths, unsigned threads, const Control& control,
                                                 SurfaceError& result) {
  if (!(total_ > 0.0)) { return true; }
  std::vector<Sample> samples(points);
  const std::uint64_t first_key = keys_;
  keys_ += points;
  const auto all = static_cast<double>(points);
  parallel_in_batches(
      control, threads, points, {512, 4},
      [&](std::size_t i) { samples[i] = measure_one(first_key + i, static_cast<double>(i) / all, 1.0 / all, paths); },
      [&](std::size_t done) { control.report("audit", static_cast<double>(done) / all); });
  if (control.cancelled()) { return false; }
  for (const Sample& sample : samples) {
    result.rays += sample.rays;
    if (!sample.valid) { continue; }
    result.leaf.add(sample.leaf, sample.reference, sample.noise);
    result.reconstructed.add(sample.reconstructed, sample.reference, sample.noise);
    result.direct += sample.direct;
    result.other += sample.other;
  }
  return true;
}

HALFLIGHT_INLINE std::optional<SurfaceErrorMeter::Spot> SurfaceErrorMeter::spot(Random& random, double from, double width) const {
  const double at = from + width * random.uniform();
  const Triangle& triangle = drawn(triangles_, at);
  const MeshFace& face = mesh_->faces[triangle.face];
  const double u = random.uniform();
  const glm::dvec3 weight = triangle_weights(u, random.uniform());
  const glm::uvec3 corners{face.first_corner, triangle.first, triangle.second};
  glm::dvec3 chord{0.0};
  for (int k = 0; k < 3; ++k) { chord += weight[k] * mesh_->positions[mesh_->corners[corners[k]].vertex]; }
  const InputSurface& input = scene_->inputs[face.surface];
  if (!(scene_->exposure.area[face.node] > 0.0)) { return std::nullopt; }
  const raycast::ScenePoint point{scene_->objects.object(input.object).project(input.sheet, chord), input.object, input.sheet};
  // Near the edge of a thin blade the nearest surface point may lie on the other side of the blade, which has leaves of its own.
  if (!(glm::dot(point.normal, outward(triangle)) > 0.0)) { return std::nullopt; }
  // A leaf that counts as exposed may still have a buried corner (exposure.hpp); paths from there start inside another object.
  if (scene_->objects.covered(point)) { return std::nullopt; }
  return Spot{&triangle, weight, point};
}

HALFLIGHT_INLINE std::uint64_t SurfaceErrorMeter::aim(const std::vector<Surface>& boundaries, unsigned threads) {
  constexpr std::uint32_t points = 128;
  if (!(total_ > 0.0)) { return 0; }
  std::optional<PathTracer> aimed = tracer_->aimed(boundaries);
  if (!aimed) { return 0; }
  const auto start = [&](std::uint32_t i) -> std::optional<PathStart> {
    Random random{seed_, i, 0x61696d696e67ull};
    const std::optional<Spot> at = spot(random, static_cast<double>(i) / points, 1.0 / points);
    if (!at) { return std::nullopt; }
    return PathStart{at->point, 1.0 / (total_ * density(*at->triangle))};
  };
  const AimingTry tried = try_aiming(*tracer_, *aimed, seed_, points, threads, start);
  if (tried.pays) {
    aimed_ = std::move(aimed);
    tracer_ = &*aimed_;
  }
  return tried.rays;
}

HALFLIGHT_INLINE double SurfaceErrorMeter::ray_price() const {
  constexpr std::uint64_t points = 256;
  PathTracer::RayCost cost;
  for (std::uint64_t i = 0; i < points && total_ > 0.0; ++i) {
    Random random{seed_, i, 0x7072696365ull};
    const std::optional<Spot> at = spot(random, static_cast<double>(i) / points, 1.0 / points);
    if (!at) { continue; }
    static_cast<void>(tracer_->radiosity(at->point, random, cost));
  }
  return cost.mean();
}

HALFLIGHT_INLINE SurfaceErrorMeter::Sample SurfaceErrorMeter::measure_one(std::uint64_t key, double from, double width,
                                                                          std::uint32_t paths) const {
  Sample sample;
  Random random{seed_, key, 0x6175646974ull};
  const std::optional<Spot> at = spot(random, from, width);
  if (!at) { return sample; }
  const MeshFace& face = mesh_->faces[at->triangle->face];
  const auto shown_by = [&, &weight = at->weight, triangle = at->triangle](const Mesh& of) {
    const glm::uvec3 corners{face.first_corner, triangle->first, triangle->second};
    Color sum{0.0};
    for (int k = 0; k < 3; ++k) { sum += weight[k] * of.corners[corners[k]].radiosity; }
    return sum;
  };
  const Color shown = shown_by(*mesh_);
  const PathEstimates light{seed_, key, paths, [&](PathNumbers& numbers) { return tracer_->radiosity(at->point, numbers, sample.rays); }};
  const Color& emission = tracer_->material(face.surface).emission;
  const double weight_of_point = 1.0 / (total_ * density(*at->triangle));
  sample.leaf = weight_of_point * light.square_off(face.radiosity);
  sample.reconstructed = weight_of_point * light.square_off(shown);
  sample.reference = weight_of_point * light.square_off(emission);
  if (direct_ != nullptr) {
    const Color once = shown_by(*direct_);
    sample.direct = weight_of_point * light.direct_square_off(once);
    sample.other = weight_of_point * light.other_square_off(shown - once);
  }
  sample.noise = weight_of_point * weight_of_point * light.noise();
  sample.valid = true;
  return sample;
}

}  // namespace radiosity
