// SPDX-License-Identifier: MIT
#pragma once

// A scene as a run cuts it up: the prepared scene, the hierarchy over its surfaces, and for each node of the hierarchy its patch and what
// of it is exposed. Refinement lets it grow; everything after refinement reads it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

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

// Its parts refer to each other, so it is neither copied nor moved.
struct DiscreteScene {
  // The scene must outlive this. Nothing is prepared yet.
  DiscreteScene(const Scene& scene, unsigned thread_limit, std::uint64_t random_seed, const Control& controlled_by = {},
                const MemoryBudget& within = {});
  DiscreteScene(const DiscreteScene&) = delete;
  DiscreteScene& operator=(const DiscreteScene&) = delete;

  // What prepare() made of the scene, and the materials of its input surfaces. The hierarchy is still empty.
  void take(Prepared prepared);

  // Makes the patches of all nodes that have none, and measures what of them is exposed.
  void expose();

  [[nodiscard]] SceneView view() const { return {objects, plan, surfaces, hierarchy, patches}; }
  // Is node 0 a cluster of all? Lamps may have clusters without that.
  [[nodiscard]] bool clustered() const { return !hierarchy.empty() && hierarchy[0].is_cluster(); }
  // Are there nodes that lose no light?
  [[nodiscard]] bool any_closed() const { return plan.closed || !closed.empty(); }
  // Is node i one of those? It is when its parent is, for nodes that are newer than `closed`.
  [[nodiscard]] bool loses_nothing(std::size_t i) const {
    if (hierarchy[i].is_cluster() || !any_closed()) { return false; }
    while (!plan.closed && i >= closed.size()) { i = hierarchy[i].parent; }
    return plan.closed || closed[i];
  }
  // What the clusters show by the exposed areas of now.
  [[nodiscard]] ShownAreas exposed_shown() const;
  // Held by the compiled objects and the BReps.
  [[nodiscard]] std::uint64_t bytes() const;

  const Scene& input;
  unsigned threads;
  std::uint64_t seed;
  Control control;
  MemoryBudget budget;
  Meshing meshing = RegularMeshing{};
  std::optional<LightMeshing> light_meshing;  // the one in use

  Frame frame;
  raycast::Scene objects;         // in the frame
  std::vector<Surface> surfaces;  // boundary of each object
  Plan plan;
  std::vector<InputSurface> inputs;
  std::vector<std::uint32_t> materials;      // of each input surface,
  std::vector<Color> reflectance, emission;  // and what these are
  std::vector<bool> closed;                  // where the plan does not say that all is: nodes that lose no light (closed_parts.hpp)
  std::vector<bool> lamps;                   // where other light goes by stored rays: input surfaces whose light goes by links

  Hierarchy hierarchy;
  Patches patches;
  Exposure exposure;
  ShownAreas shown;  // by the clusters
  LinkEvaluator evaluator;
  std::optional<LampExchange> lamp_exchange;  // the one in use
};

[[nodiscard]] inline SurfaceLight surface_light(const DiscreteScene& scene) {
  return {scene.reflectance, scene.emission, scene.plan.channels};
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/discrete_scene.cpp>
#endif
