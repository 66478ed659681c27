// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cctype>

#include <glm/geometric.hpp>

#include "apps/intake/model.hpp"
#include "apps/mesh_file.hpp"
#include "apps/scene_file/words.hpp"

namespace apps {
namespace intake {

extern const ModelFormat obj, ply, off, gltf, glb, wrl, mgf_format;

}  // namespace intake

std::span<const ModelFormat* const> model_formats() {
  static constexpr std::array formats{&intake::obj, &intake::gltf, &intake::glb,       &intake::ply,
                                      &intake::off, &intake::wrl,  &intake::mgf_format};
  return formats;
}

std::string model_endings() {
  std::vector<std::string_view> endings;
  for (const ModelFormat* const format : model_formats()) { endings.push_back(format->ending); }
  return scene_file::list_of(endings);
}

const ModelFormat* model_format(std::string_view path, std::string_view bytes) {
  for (const ModelFormat* const format : model_formats()) {
    if (path == "-" ? format->begins(bytes) : has_ending(path, format->ending)) { return format; }
  }
  return nullptr;
}

bool usable(const Camera& camera) {
  const auto in_reach = [](const glm::dvec3& v) { return glm::length(v) <= max_number; };  // false for NaN
  const double sine = glm::length(glm::cross(camera.forward, camera.up));
  return in_reach(camera.eye) && in_reach(camera.forward) && in_reach(camera.up) &&
         sine > 1e-9 * glm::length(camera.forward) * glm::length(camera.up) && camera.field_of_view >= 0.001 &&
         camera.field_of_view <= 179.0;
}

std::vector<std::string> Notes::take() const {
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [sentence, entry] : entries_) {
    std::string text = sentence;
    if (entry.count > 1) { text += ", " + std::to_string(entry.count) + " times"; }
    if (!entry.place.empty()) { text += (entry.count > 1 ? ", first " : ", ") + entry.place; }
    sorted.emplace_back(entry.number, std::move(text));
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::string> sentences;
  for (auto& [number, text] : sorted) { sentences.push_back(std::move(text)); }
  return sentences;
}

}  // namespace apps
