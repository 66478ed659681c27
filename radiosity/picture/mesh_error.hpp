// SPDX-License-Identifier: MIT
#pragma once

// The error of a mesh's colours relative to the light gathered for a picture (final_gather.hpp): relative L2 over the exposed surfaces,
// from random points at which that light is computed with two independent sets of rays (error_estimate.hpp). Different meshes of a scene
// are compared with the same points.

#include <cstdint>
#include <optional>
#include <vector>

#include <radiosity/picture/final_gather.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

class MeshErrorMeter {
 public:
  // Gathers light at `points` points of the mesh (in scene coordinates), half of them distributed by area, half by the squared reflected
  // light. `scene` and `light` must outlive this. When cancelled, there are no points. If scene.control.viewpoint is set, errors are
  // weighted by the picture.
  MeshErrorMeter(const DiscreteScene& scene, const FinalGather& light, const Mesh& mesh, std::uint64_t points);

  // The error of another mesh of the same surfaces. Nothing without points, or if they see no light.
  [[nodiscard]] std::optional<ErrorEstimate> measure(const Mesh& mesh) const;
  // The squared reflected light, integrated over the surfaces (in the frame) or over the picture.
  [[nodiscard]] double square() const;

 private:
  struct Sample {
    FinalGather::Place place;
    Color light[2] = {Color{0.0}, Color{0.0}};  // W/m2
    double weight = 0.0;                        // 0: buried
  };
  const DiscreteScene* scene_;
  const FinalGather* light_;
  std::vector<Sample> samples_;
  double area_ = 0.0;  // of all triangles; or their area in the picture
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/mesh_error.cpp>
#endif
