// SPDX-License-Identifier: MIT
#pragma once

// A discretised scene: the prepared scene, the hierarchy over its surfaces, and for each node its patch and its exposed part. Refinement
// extends it; everything after refinement only reads it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/clusters/clusters.hpp>
#include <radiosity/clusters/lamp_exchange.hpp>
#include <radiosity/discontinuity/light_meshing.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <radiosity/visibility/scene_view.hpp>

namespace radiosity {

// The nodes that lose no light, as far as rays tell (audit/closed_parts.hpp).
struct PartsWithoutLoss {
  std::vector<bool> all;                   // by node: is it in a part that loses no light?
  std::vector<bool> but_backs;             // by node: in a part that loses light to black backs alone? It loses none in front of all these
  std::vector<raycast::ScenePoint> backs;  // a point in the plane of each of these backs
};

// The parts refer to each other, so it can be neither copied nor moved.
struct DiscreteScene {
  // `scene` must outlive this. Nothing is prepared yet.
  DiscreteScene(const Scene& scene, unsigned thread_limit, std::uint64_t random_seed, const Control& controlled_by = {},
                const MemoryBudget& within = {});
  DiscreteScene(const DiscreteScene&) = delete;
  DiscreteScene& operator=(const DiscreteScene&) = delete;

  // Takes over the result of prepare() and looks up the materials of the input surfaces. The hierarchy is still empty.
  void take(Prepared prepared);

  // Makes the patches of all nodes that have none, and measures their exposed parts.
  void expose();

  [[nodiscard]] SceneView view() const { return {objects, plan, surfaces, hierarchy, patches}; }
  // Is node 0 a cluster of the whole scene? Lamps may have clusters even if it is not.
  [[nodiscard]] bool clustered() const { return !hierarchy.empty() && hierarchy[0].is_cluster(); }
  // Are there nodes that lose no light?
  [[nodiscard]] bool any_closed() const { return plan.closed || !closed.all.empty(); }
  // Does node i lose no light? Nodes newer than these lists are in the lists of their parents.
  [[nodiscard]] bool loses_nothing(std::size_t i) const { return plan.closed ? !hierarchy[i].is_cluster() : loses_nothing(closed, i); }
  [[nodiscard]] bool loses_nothing(const PartsWithoutLoss& lists, std::size_t i) const;
  // The clusters' projected areas, from the current exposed areas.
  [[nodiscard]] ShownAreas exposed_shown() const;
  // Bytes held by the compiled objects and the BReps.
  [[nodiscard]] std::uint64_t bytes() const;

  const Scene& input;
  unsigned threads;
  std::uint64_t seed;
  Control control;
  MemoryBudget budget;
  Meshing meshing = RegularMeshing{};
  std::optional<LightMeshing> light_meshing;  // referred to by `meshing`

  Frame frame;
  raycast::Scene objects;         // in the frame
  std::vector<Surface> surfaces;  // boundary of each object
  Plan plan;
  std::vector<InputSurface> inputs;
  std::vector<std::uint32_t> materials;      // by input surface
  std::vector<Color> reflectance, emission;  // of these materials
  PartsWithoutLoss closed;                   // empty if plan.closed says so of all or no closed part was found
  std::vector<bool> lamps;                   // by input surface, if other light goes by stored rays: does its light go by links?

  Hierarchy hierarchy;
  Patches patches;
  Exposure exposure;
  ShownAreas shown;  // projected areas of the clusters
  LinkEvaluator evaluator;
  std::optional<LampExchange> lamp_exchange;  // referred to by `evaluator`
};

[[nodiscard]] inline SurfaceLight surface_light(const DiscreteScene& scene) {
  return {scene.reflectance, scene.emission, scene.plan.channels};
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/discrete_scene.cpp>
#endif
