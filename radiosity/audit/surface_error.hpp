// SPDX-License-Identifier: MIT
#pragma once

// The error of a solution on all surfaces, each part of their area counting alike: the mesh against path-traced radiosities at random
// points of it (error_estimate.hpp). A third of the points is spread evenly over the area, a third by the square of the reflected
// radiosity, and a third by the square of the difference between a leaf and its corners, because most of the error lies where there is
// light and where it changes. Each point counts with the inverse of its density, which is at most 3. Without the last third the intervals
// of scenes with small bright spots and sharp shadows are up to four times as wide (primitives 2.5 % to 8.7 %, with it 3.8 % to 5.2 %).

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

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
                    const Mesh* direct, std::uint64_t seed);
  SurfaceErrorMeter(const SurfaceErrorMeter&) = delete;
  SurfaceErrorMeter& operator=(const SurfaceErrorMeter&) = delete;

  // From now on paths are aimed at bright places, if that pays (aimed_paths.hpp). `boundaries`: of the objects. Returns the rays that it
  // took to know.
  std::uint64_t aim(const std::vector<Surface>& boundaries, unsigned threads);

  // Adds `points` fresh points, spread evenly over the mesh; buried ones, and those nearest to the back of a blade, do not count.
  // False when cancelled.
  [[nodiscard]] bool measure(std::uint64_t points, std::uint32_t paths, unsigned threads, const Control& control, SurfaceError& result);

  // What a ray of the paths from such points costs (PathTracer::RayCost): the mean over 256 of them. 0 where none counts.
  [[nodiscard]] double ray_price() const;

 private:
  struct Triangle {
    std::uint32_t face, first, second;  // corners face.first_corner, first, second
    double area, light;                 // square of the reflected radiosity
    double contrast;                    // mean square of what the corners differ from the leaf: where it is large, errors mostly are
    double until = 0.0;                 // share of the points that fall on it or one before
  };
  struct Sample {
    double leaf = 0.0, reconstructed = 0.0, reference = 0.0, noise = 0.0, direct = 0.0, other = 0.0;
    std::uint64_t rays = 0;
    bool valid = false;
  };

  // Of the points, per area.
  [[nodiscard]] double density(const Triangle& triangle) const {
    if (!(light_ > 0.0)) { return 1.0 / total_; }
    if (!(contrast_ > 0.0)) { return 0.5 / total_ + 0.5 * triangle.light / light_; }
    return (1.0 / total_ + triangle.light / light_ + triangle.contrast / contrast_) / 3.0;
  }

  // Normal to it, on the side of the air.
  [[nodiscard]] glm::dvec3 outward(const Triangle& triangle) const;
  // A random point of the part [from, from + width] of all, 1 the whole; nothing where it does not count.
  struct Spot {
    const Triangle* triangle;
    glm::dvec3 weight{0.0};  // of the triangle's corners
    raycast::SurfacePoint point;
  };
  [[nodiscard]] std::optional<Spot> spot(Random& random, double from, double width) const;
  // At such a point.
  [[nodiscard]] Sample measure_one(std::uint64_t key, double from, double width, std::uint32_t paths) const;

  const raycast::Scene* objects_;
  const PathTracer* tracer_;
  std::optional<PathTracer> aimed_;
  const Exposure* exposure_;
  const Mesh* mesh_;
  const Mesh* direct_;
  std::vector<InputSurface> inputs_;
  std::vector<Triangle> triangles_;
  double total_ = 0.0, light_ = 0.0, contrast_ = 0.0;  // area, and the integrals over it
  std::uint64_t keys_ = 0;                             // of the random numbers that were used
  std::uint64_t seed_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/surface_error.cpp>
#endif
