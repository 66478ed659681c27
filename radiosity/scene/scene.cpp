// SPDX-License-Identifier: MIT
#include <radiosity/scene/scene.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/material.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::vector<InputSurface> surfaces(const Scene& scene) {
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

HALFLIGHT_INLINE std::vector<std::string> faults(const Scene& scene) {
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
