// SPDX-License-Identifier: MIT
#pragma once

// Hierarchies of input faces, split as a test wants them, without light or links.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/rays/senders.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "catch.hpp"
#include "scenes.hpp"

namespace roots {

// The input faces of a scene as the roots of a hierarchy.
inline std::unique_ptr<radiosity::DiscreteScene> roots_of(const radiosity::Scene& scene, unsigned threads = 1, std::uint64_t seed = 1) {
  radiosity::PrepareResult made = radiosity::prepare(scene);
  for (const std::string& fault : made.faults) { UNSCOPED_INFO(fault); }
  REQUIRE(made.prepared);
  auto discrete = std::make_unique<radiosity::DiscreteScene>(scene, threads, seed);
  discrete->take(std::move(*made.prepared));
  discrete->hierarchy = radiosity::make_roots(discrete->surfaces);
  return discrete;
}

inline void split_at_random(radiosity::DiscreteScene& scene, std::mt19937_64& random, int splits) {
  for (int k = 0; k < splits; ++k) {
    const auto i = std::uniform_int_distribution<std::size_t>{0, scene.hierarchy.size() - 1}(random);
    if (scene.hierarchy[i].leaf()) {
      static_cast<void>(radiosity::subdivide(scene.surfaces, scene.hierarchy, static_cast<std::uint32_t>(i), scene.meshing));
    }
  }
}

inline radiosity::Scene closed_room(std::vector<radiosity::SceneObject> things, double lamp_height = 1.0, double emission = 5.0) {
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.7}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{emission}}};
  scene.objects = {
      scenes::object("room", scenes::box({0, 0, 0}, {1, 1, 1}), 0, true),
      scenes::object(
          "lamp",
          scenes::polygon({{0.35, 0.35, lamp_height}, {0.35, 0.65, lamp_height}, {0.65, 0.65, lamp_height}, {0.65, 0.35, lamp_height}}),
          1)};
  for (radiosity::SceneObject& thing : things) { scene.objects.push_back(std::move(thing)); }
  return scene;
}

inline std::vector<std::uint32_t> leaves_of(const radiosity::DiscreteScene& scene) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t i = 0; i < scene.hierarchy.size(); ++i) {
    if (scene.hierarchy[i].leaf()) { leaves.push_back(i); }
  }
  return leaves;
}

// All leaves cast, as if they saw the same light.
inline std::vector<radiosity::Caster> casters_of(const radiosity::DiscreteScene& scene) {
  std::vector<radiosity::Caster> casters;
  for (const std::uint32_t i : leaves_of(scene)) { casters.push_back({i, 1.0}); }
  return casters;
}

}  // namespace roots
