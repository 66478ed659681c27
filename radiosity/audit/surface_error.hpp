// SPDX-License-Identifier: MIT
#pragma once

// The error of a solution over all surfaces, by area: the mesh is compared with path-traced radiosities at random points
// (error_estimate.hpp). A third of the points is uniform over the area, a third is distributed by the squared reflected radiosity, and a
// third by the squared difference between a leaf and its corners, because most of the error lies where there is light and where it
// changes. Each point is weighted with the inverse of its density, which is at most 3 times that of a uniform draw. Without the last
// third the intervals of scenes with small bright spots and sharp shadows are up to four times as wide (primitives 2.5 % to 8.7 %, with
// it 3.8 % to 5.2 %).

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

struct SurfaceError {
  ErrorSums leaf, reconstructed;     // of constant radiosity on each leaf; of radiosity interpolated between the corners of the mesh
  double direct = 0.0, other = 0.0;  // squared errors of the light reflected once and of the rest, summed over the points
  std::uint64_t rays = 0;

  [[nodiscard]] std::uint64_t points() const { return leaf.square.size(); }
};

class SurfaceErrorMeter {
 public:
  // `mesh` is in the frame. `direct`: the same mesh with only the light that was reflected once, or null. The references must outlive the
  // meter.
  SurfaceErrorMeter(const DiscreteScene& scene, const PathTracer& tracer, const Mesh& mesh, const Mesh* direct, std::uint64_t seed);
  SurfaceErrorMeter(const SurfaceErrorMeter&) = delete;
  SurfaceErrorMeter& operator=(const SurfaceErrorMeter&) = delete;

  // From now on paths are aimed at bright places if that pays (aimed_paths.hpp). `boundaries`: of the objects. Returns the number of rays
  // that the trial cast.
  std::uint64_t aim(const std::vector<Surface>& boundaries, unsigned threads);

  // Adds `points` fresh points, stratified over the mesh. Points that are buried or project onto the back of a thin blade do not count.
  // Returns false when cancelled.
  [[nodiscard]] bool measure(std::uint64_t points, std::uint32_t paths, unsigned threads, const Control& control, SurfaceError& result);

  // Cost of a path-tracing ray from such points, in microseconds (PathTracer::RayCost): the mean over 256 points; 0 if none of them counts.
  [[nodiscard]] double ray_price() const;

 private:
  struct Triangle {
    std::uint32_t face, first, second;  // corners of the triangle: face.first_corner, first, second
    double area, light;                 // light: mean squared reflected radiosity
    double contrast;                    // mean squared difference between corners and leaf; errors are mostly large where it is
    double until = 0.0;                 // cumulative share of the points, up to and including this triangle
  };
  struct Sample {
    double leaf = 0.0, reconstructed = 0.0, reference = 0.0, noise = 0.0, direct = 0.0, other = 0.0;
    std::uint64_t rays = 0;
    bool valid = false;
  };

  // Density of the points, per area.
  [[nodiscard]] double density(const Triangle& triangle) const {
    if (!(light_ > 0.0)) { return 1.0 / total_; }
    if (!(contrast_ > 0.0)) { return 0.5 / total_ + 0.5 * triangle.light / light_; }
    return (1.0 / total_ + triangle.light / light_ + triangle.contrast / contrast_) / 3.0;
  }

  // Unit normal on the side of the air.
  [[nodiscard]] glm::dvec3 outward(const Triangle& triangle) const;
  // A random point from the stratum [from, from + width] of [0, 1); nothing if it does not count.
  struct Spot {
    const Triangle* triangle;
    glm::dvec3 weight{0.0};  // barycentric coordinates
    raycast::ScenePoint point;
  };
  [[nodiscard]] std::optional<Spot> spot(Random& random, double from, double width) const;
  // Compares mesh and path tracer at such a point.
  [[nodiscard]] Sample measure_one(std::uint64_t key, double from, double width, std::uint32_t paths) const;

  const DiscreteScene* scene_;
  const PathTracer* tracer_;
  std::optional<PathTracer> aimed_;
  const Mesh* mesh_;
  const Mesh* direct_;
  std::vector<Triangle> triangles_;
  double total_ = 0.0, light_ = 0.0, contrast_ = 0.0;  // total area, and the integrals of light and contrast over it
  std::uint64_t keys_ = 0;                             // number of random sequences used so far
  std::uint64_t seed_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/surface_error.cpp>
#endif
