// SPDX-License-Identifier: MIT
#pragma once

// The input: objects that keep their analytic shape from start to end (paper 4.1), each with the materials of
// its sheets. Nothing in here is ever changed by a run.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/material.hpp>

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
[[nodiscard]] inline std::vector<InputSurface> surfaces(const Scene& scene) {
  std::vector<InputSurface> result;
  for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
    const SceneObject& object = scene.objects[o];
    const std::uint32_t sheets = object.shape->sheet_count();
    for (std::uint32_t s = 0; s < sheets; ++s) {
      std::string name = object.name;
      if (sheets > 1) { name.append(".").append(object.shape->sheet_name(s)); }
      result.push_back({o, s, object.material[object.material.size() == 1 ? 0 : s], std::move(name)});
    }
  }
  return result;
}

// Every fault of the scene, one sentence each; empty when it can be solved.
[[nodiscard]] inline std::vector<std::string> faults(const Scene& scene) {
  std::vector<std::string> sentences;
  for (const Material& material : scene.materials) {
    if (auto sentence = fault(material)) { sentences.push_back(std::move(*sentence)); }
  }
  if (scene.objects.empty()) { sentences.emplace_back("the scene has no objects"); }
  for (const SceneObject& object : scene.objects) {
    const std::string who = "object '" + object.name + "': ";
    if (object.shape == nullptr) {
      sentences.push_back(who + "has no shape");
      continue;
    }
    if (auto sentence = raycast::check(*object.shape, object.placement)) { sentences.push_back(who + *sentence); }
    if (object.material.size() != 1 && object.material.size() != object.shape->sheet_count()) {
      sentences.push_back(who + "has " + std::to_string(object.material.size()) + " materials for " +
                          std::to_string(object.shape->sheet_count()) + " sheets; give one, or one a sheet");
    }
    for (const std::uint32_t m : object.material) {
      if (m >= scene.materials.size()) { sentences.push_back(who + "names material " + std::to_string(m) + ", which does not exist"); }
    }
  }
  return sentences;
}

}  // namespace radiosity
