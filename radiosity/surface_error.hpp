// SPDX-License-Identifier: MIT
#pragma once

// The error of a solution on all surfaces, each part of their area counting alike: the mesh against path-traced radiosities at random
// points of it (error_estimate.hpp). Half of the points are spread evenly over the area, half by the square of the reflected radiosity,
// for where there is light most of the error is; each counts with the inverse of its density, which is at most 2.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/error_estimate.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/mesh.hpp>
#include <radiosity/options.hpp>
#include <radiosity/parallel.hpp>
#include <radiosity/path_tracer.hpp>
#include <radiosity/sobol.hpp>

namespace radiosity {

// Two independent estimates of the radiosity at a point, each the mean of `paths` paths of an even sequence. `key` names the point.
// `first_point(numbers, estimate)` traces one path and returns the light that it found.
struct TwoEstimates {
  Color all[2] = {Color{0.0}, Color{0.0}};
  Color direct[2] = {Color{0.0}, Color{0.0}};  // the part that is emitted, or was reflected once

  template <class Trace>
  TwoEstimates(std::uint64_t seed, std::uint64_t key, std::uint32_t paths, const Trace& trace) {
    for (std::uint64_t half = 0; half < 2; ++half) {
      const Sobol4 first{seed, 4 * key + 2 * half};
      const Sobol4 second{seed, 4 * key + 2 * half + 1};
      for (std::uint32_t k = 0; k < paths; ++k) {
        PathNumbers numbers{first, second, k, Random{seed, key, half << 32 | k}};
        const PathTracer::Light light = trace(numbers);
        all[half] += light.all / static_cast<double>(paths);
        direct[half] += light.direct / static_cast<double>(paths);
      }
    }
  }

  // What the noise of both adds to the variance of the product of their errors. The product of two errors of variance v has the variance
  // v^2; so has a third of the square of half their squared difference.
  [[nodiscard]] double noise() const {
    const double half_square = 0.5 * glm::dot(all[0] - all[1], all[0] - all[1]);
    return half_square * half_square / 3.0;
  }
};

struct SurfaceError {
  ErrorSums leaf, reconstructed;     // of the constant on each leaf; of the radiosity that is interpolated between the mesh's corners
  double direct = 0.0, other = 0.0;  // squared errors of the light that was reflected once, and of the rest, summed over the points
  std::uint64_t rays = 0;

  [[nodiscard]] std::uint64_t points() const { return leaf.square.size(); }
};

class SurfaceErrorMeter {
 public:
  // The mesh is in the frame; `direct`, if given: the same mesh, but with the light that was reflected once. The references must outlive
  // the meter.
  SurfaceErrorMeter(const Scene& scene, const raycast::Scene& objects, const PathTracer& tracer, const Exposure& exposure, const Mesh& mesh,
                    const Mesh* direct, std::uint64_t seed)
      : objects_{&objects}, tracer_{&tracer}, exposure_{&exposure}, mesh_{&mesh}, direct_{direct}, inputs_{surfaces(scene)}, seed_{seed} {
    const auto corner = [&](std::uint32_t c) -> const glm::dvec3& { return mesh.positions[mesh.corners[c].vertex]; };
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      const MeshFace& face = mesh.faces[f];
      const Color reflected = face.radiosity - tracer.material(face.surface).emission;
      for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
        const std::uint32_t a = face.first_corner;
        const double area = 0.5 * glm::length(glm::cross(corner(a + k) - corner(a), corner(a + k + 1) - corner(a)));
        triangles_.push_back({f, a + k, a + k + 1, area, glm::dot(reflected, reflected)});
        total_ += area;
        light_ += area * triangles_.back().light;
      }
    }
    double before = 0.0;
    for (Triangle& triangle : triangles_) { before = triangle.until = before + triangle.area * density(triangle); }
  }

  // Adds `points` fresh points, spread evenly over the mesh; those that are buried do not count. False when cancelled.
  [[nodiscard]] bool measure(std::uint64_t points, std::uint32_t paths, unsigned threads, const Control& control, SurfaceError& result) {
    if (!(total_ > 0.0)) { return true; }
    std::vector<Sample> samples(points);
    const std::uint64_t first_key = keys_;
    keys_ += points;
    constexpr std::size_t batch = 512;  // between two looks at the cancel flag
    for (std::size_t first = 0; first < points && !control.cancelled(); first += batch) {
      parallel_for(
          std::min<std::size_t>(batch, points - first), threads,
          [&](std::size_t offset) {
            const std::size_t i = first + offset;
            if (!control.cancelled()) {
              samples[i] = measure_one(first_key + i, static_cast<double>(i) / static_cast<double>(points),
                                       1.0 / static_cast<double>(points), paths);
            }
          },
          4);
      control.report("audit", static_cast<double>(std::min<std::size_t>(first + batch, points)) / static_cast<double>(points));
    }
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

 private:
  struct Triangle {
    std::uint32_t face, first, second;  // corners face.first_corner, first, second
    double area, light;                 // square of the reflected radiosity
    double until = 0.0;                 // share of the points that fall on it or one before
  };
  struct Sample {
    double leaf = 0.0, reconstructed = 0.0, reference = 0.0, noise = 0.0, direct = 0.0, other = 0.0;
    std::uint64_t rays = 0;
    bool valid = false;
  };

  // Of the points, per area.
  [[nodiscard]] double density(const Triangle& triangle) const {
    return light_ > 0.0 ? 0.5 / total_ + 0.5 * triangle.light / light_ : 1.0 / total_;
  }

  // At a point of the part [from, from + width] of all, 1 the whole.
  [[nodiscard]] Sample measure_one(std::uint64_t key, double from, double width, std::uint32_t paths) const {
    Sample sample;
    Random random{seed_, key, 0x6175646974ull};
    const double at = from + width * random.uniform();
    auto triangle = std::upper_bound(triangles_.begin(), triangles_.end(), at, [](double a, const Triangle& t) { return a < t.until; });
    if (triangle == triangles_.end()) { --triangle; }
    const MeshFace& face = mesh_->faces[triangle->face];
    const double root = std::sqrt(random.uniform());
    const double v = random.uniform();
    const glm::dvec3 weight{1.0 - root, root * (1.0 - v), root * v};
    const glm::uvec3 corners{face.first_corner, triangle->first, triangle->second};
    glm::dvec3 chord{0.0};
    for (int k = 0; k < 3; ++k) { chord += weight[k] * mesh_->positions[mesh_->corners[corners[k]].vertex]; }
    const auto shown_by = [&](const Mesh& of) {
      Color sum{0.0};
      for (int k = 0; k < 3; ++k) { sum += weight[k] * of.corners[corners[k]].radiosity; }
      return sum;
    };
    const Color shown = shown_by(*mesh_);
    const InputSurface& input = inputs_[face.surface];
    if (!(exposure_->area[face.node] > 0.0)) { return sample; }
    const raycast::SurfacePoint point = objects_->object(input.object).project(input.sheet, chord);
    // Of a leaf that counts as exposed a corner may be buried all the same (exposure.hpp): seen from within what buries it, all is wrong.
    if (objects_->covered(point.position, point.normal, input.object)) { return sample; }

    const TwoEstimates light{seed_, key, paths, [&](PathNumbers& numbers) {
                               return tracer_->radiosity(point.position, point.normal, input.object, input.sheet, numbers, sample.rays);
                             }};
    const Color& emission = tracer_->material(face.surface).emission;
    const double weight_of_point = 1.0 / (total_ * density(*triangle));
    sample.leaf = weight_of_point * glm::dot(light.all[0] - face.radiosity, light.all[1] - face.radiosity);
    sample.reconstructed = weight_of_point * glm::dot(light.all[0] - shown, light.all[1] - shown);
    sample.reference = weight_of_point * glm::dot(light.all[0] - emission, light.all[1] - emission);
    if (direct_ != nullptr) {
      const Color once = shown_by(*direct_);
      sample.direct = weight_of_point * glm::dot(light.direct[0] - once, light.direct[1] - once);
      const Color rest = shown - once;
      sample.other = weight_of_point * glm::dot(light.all[0] - light.direct[0] - rest, light.all[1] - light.direct[1] - rest);
    }
    sample.noise = weight_of_point * weight_of_point * light.noise();
    sample.valid = true;
    return sample;
  }

  const raycast::Scene* objects_;
  const PathTracer* tracer_;
  const Exposure* exposure_;
  const Mesh* mesh_;
  const Mesh* direct_;
  std::vector<InputSurface> inputs_;
  std::vector<Triangle> triangles_;
  double total_ = 0.0, light_ = 0.0;  // area, and the integral of the light over it
  std::uint64_t keys_ = 0;            // of the random numbers that were used
  std::uint64_t seed_;
};

}  // namespace radiosity
