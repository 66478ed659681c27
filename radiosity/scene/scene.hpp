// SPDX-License-Identifier: MIT
#pragma once

// The input: objects that keep their analytic shape from start to end (paper 4.1), each with the materials of
// its sheets. Nothing in here is ever changed by a run.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/material.hpp>

namespace radiosity {

struct SceneObject {
  std::string name;
  std::shared_ptr<const raycast::Object> shape;
  raycast::Placement placement;
  std::vector<std::uint32_t> material;  // indices into Scene::materials: one for all sheets, or one a sheet
};

struct Scene {
  std::vector<Material> materials;
  std::vector<SceneObject> objects;
};

// One sheet of one object: the unit in which results are reported.
struct InputSurface {
  std::uint32_t object = 0;
  std::uint32_t sheet = 0;
  std::uint32_t material = 0;
  std::string name;  // "floor", or "room.x0" when the object has several sheets
};

// All input surfaces, in the order of objects, then sheets. The scene must be sound (see faults()).
[[nodiscard]] std::vector<InputSurface> surfaces(const Scene& scene);

// Every fault of the scene, one sentence each; empty when it can be solved.
[[nodiscard]] std::vector<std::string> faults(const Scene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/scene/scene.cpp>
#endif
