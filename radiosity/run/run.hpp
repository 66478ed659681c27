// SPDX-License-Identifier: MIT
#pragma once

// The state of a run, on which its stages (stages.hpp) operate one after the other.

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
  // `input` must outlive the run. `within`: with the limits set; the fixed memory of the run is added later.
  Run(const Scene& input, const Options& with, const Control& control, const MemoryBudget& within);

  // Checks and compiles the scene; returns the reason if that is not possible.
  [[nodiscard]] std::optional<Failure> prepare_scene();
  // The mesh of the current leaves with this light, in the frame.
  [[nodiscard]] Mesh picture(const std::vector<Color>& radiosity, Reconstruction kind);
  // The result, once all stages are done.
  [[nodiscard]] Outcome finish();

  // False without light or without reflection, because then B = E on the input faces.
  [[nodiscard]] bool needs_links() const { return (scene.plan.lit && scene.plan.reflects) || !scene.plan.shortcuts; }
  [[nodiscard]] bool f_refined() const { return needs_links() && options.refinement == Refinement::a_priori; }
  // Has the run been told to stop, whether or not it has reacted yet?
  [[nodiscard]] bool stopped() const { return solution.audit.interrupted || scene.control.cancelled(); }
  [[nodiscard]] bool bf_refined() const { return needs_links() && options.refinement == Refinement::a_posteriori; }

  Options options;
  Solution solution;  // as far as known; its hierarchy stays in the scene until the end
  Stopwatch watch{solution.audit.stages};
  DiscreteScene scene;
  std::optional<PathTracer> tracer;  // of the boundaries before they were cut
  ClusterChoice clusters;
  RayChoice rays;
  Importance importance;  // of the nodes, for the picture of one camera
  RefineResult refined;
  std::uint64_t rays_of_spacing = 0;
  RayLinks ray_links;  // their links are moved into the solution
  EvaluateResult evaluated;
  LinkDoubts doubts;  // of the links, until these are split
  LinkSplits link_splits;
  LeafSplits leaf_splits;
  double unseen = 0.0;  // share of the estimated squared error from links whose segments were all blocked
  std::optional<Transport> transport;
  bool t_vertices = false;          // were any eliminated?
  std::optional<Mesh> direct;       // mesh with the light that was reflected once
  std::vector<Surface> leaf_faces;  // before T-vertices were eliminated, if the mesh is to be refined
};

[[nodiscard]] inline std::optional<Failure> cancelled() {
  return Failure{Failure::Kind::cancelled, {"the run was interrupted before there was a solution"}};
}

// Converts the mesh from the frame to scene coordinates.
inline void to_scene(Mesh& mesh, const Frame& frame) {
  for (glm::dvec3& p : mesh.positions) { p = frame.to_scene(p); }
}

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/run.cpp>
#endif
