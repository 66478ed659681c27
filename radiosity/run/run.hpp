// SPDX-License-Identifier: MIT
#pragma once

// All that a run holds while its stages (stages.hpp) go over it, one after the other.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/rays/ray_choice.hpp>
#include <radiosity/rays/ray_links.hpp>
#include <radiosity/refinement/cluster_choice.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/refinement/leaf_splits.hpp>
#include <radiosity/refinement/link_splits.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/support/memory.hpp>

namespace radiosity {

namespace detail {

struct Run {
  // The scene must outlive the run. `within`: the limits are set; what the run takes in any case becomes known later.
  Run(const Scene& input, const Options& with, const Control& control, const MemoryBudget& within);

  // Checks the scene and compiles it; why that was not possible.
  [[nodiscard]] std::optional<Failure> prepare_scene();
  // The mesh, in the frame, of the leaves as they are now, with this light.
  [[nodiscard]] Mesh picture(const std::vector<Color>& radiosity, Reconstruction kind);
  // The result once all stages are done.
  [[nodiscard]] Outcome finish();

  // Without light, or without reflection, B = E on the input faces.
  [[nodiscard]] bool needs_links() const { return (scene.plan.lit && scene.plan.reflects) || !scene.plan.shortcuts; }
  [[nodiscard]] bool f_refined() const { return needs_links() && options.refinement == Refinement::a_priori; }
  // Told to stop, whether or not that has been heeded.
  [[nodiscard]] bool stopped() const { return solution.audit.interrupted || scene.control.cancelled(); }
  [[nodiscard]] bool bf_refined() const { return needs_links() && options.refinement == Refinement::a_posteriori; }

  Options options;
  Solution solution;  // what is known of it; its hierarchy stays in the scene until the end
  Stopwatch watch{solution.audit.stages};
  DiscreteScene scene;
  std::optional<PathTracer> tracer;  // of the boundaries before they were cut
  ClusterChoice clusters;
  RayChoice rays;
  Importance importance;  // of nodes, for the picture of one camera
  RefineResult refined;
  std::uint64_t rays_of_spacing = 0;
  RayLinks ray_links;  // their links go into the solution
  EvaluateResult evaluated;
  LinkDoubts doubts;  // of the links, until these are split
  LinkSplits link_splits;
  LeafSplits leaf_splits;
  double unseen = 0.0;  // part of the estimated error
  std::optional<Transport> transport;
  bool t_vertices = false;          // some were eliminated
  std::optional<Mesh> direct;       // of the light that was reflected once
  std::vector<Surface> leaf_faces;  // before T-vertices were eliminated, when the mesh is to be refined
};

[[nodiscard]] inline std::optional<Failure> cancelled() {
  return Failure{Failure::Kind::cancelled, {"the run was interrupted before there was a solution"}};
}

// From the frame into the scene's own coordinates.
inline void to_scene(Mesh& mesh, const Frame& frame) {
  for (glm::dvec3& p : mesh.positions) { p = frame.to_scene(p); }
}

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/run.cpp>
#endif
