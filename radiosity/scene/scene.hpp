// SPDX-License-Identifier: MIT
#pragma once

// The input: objects that keep their analytic shape from start to end (paper 4.1), each with the materials of its sheets. A run
// never changes it.

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
  std::vector<std::uint32_t> material;  // indices into Scene::materials: one for all sheets, or one per sheet
};

struct Scene {
  std::vector<Material> materials;
  std::vector<SceneObject> objects;
};

// A sheet of an object: the unit for which results are reported.
struct InputSurface {
  std::uint32_t object = 0;
  std::uint32_t sheet = 0;
  std::uint32_t material = 0;
  std::string name;  // "floor", or "room.x0" when the object has several sheets
};

// All input surfaces, ordered by object, then sheet. The scene must be valid (see faults()).
[[nodiscard]] std::vector<InputSurface> surfaces(const Scene& scene);

// Every fault of the scene, one sentence each; empty if it can be solved.
[[nodiscard]] std::vector<std::string> faults(const Scene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/scene/scene.cpp>
#endif
