// SPDX-License-Identifier: MIT
#pragma once

// How far the colours of a mesh are from the light that is gathered for a picture (final_gather.hpp): relative L2 over the exposed
// surfaces, from random points at which that light is known by two independent sets of rays (error_estimate.hpp). Any mesh of the scene is
// held against the same points, so that two can be compared.

#include <cstdint>
#include <optional>
#include <vector>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

class MeshErrorMeter {
 public:
  // Gathers light at `points` points of the mesh, in the scene's coordinates; half of them are spread by area, half by the square of the
  // reflected light. `scene` and `light` must outlive this. When cancelled there are no points.
  MeshErrorMeter(const Scene& scene, const FinalGather& light, const Mesh& mesh, std::uint64_t points, std::uint64_t seed, unsigned threads,
                 const Control& control);  // `control.viewpoint`: errors count by the picture

  // Of another mesh of the same surfaces. Nothing without points, or when they see no light.
  [[nodiscard]] std::optional<ErrorEstimate> measure(const Mesh& mesh) const;
  // The square of the reflected light, integrated over the surfaces, in the frame, or over the picture.
  [[nodiscard]] double square() const;

 private:
  struct Sample {
    FinalGather::Place place;
    Color light[2] = {Color{0.0}, Color{0.0}};  // W/m2
    double weight = 0.0;                        // 0: buried
  };
  const Scene* scene_;
  const FinalGather* light_;
  std::vector<Sample> samples_;
  double area_ = 0.0;  // of all triangles, or what they take of the picture
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/mesh_error.cpp>
#endif
