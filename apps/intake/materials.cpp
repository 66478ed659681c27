// SPDX-License-Identifier: MIT
#include "apps/intake/materials.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <radiosity/scene/scene.hpp>

#include "apps/mesh_file/reading.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps {
namespace {

using Materials = std::vector<radiosity::Material>;

// Diffuse light alone is solved for, so what reflects as a mirror alone would be black: it is taken as paint of the same colour.
Materials with_reflectances(const Model& model, const ModelOptions& options, std::vector<std::string>& notes) {
  Materials materials;
  std::size_t open = 0, bright = 0, mirrors = 0;
  for (const ModelMaterial& given : model.materials) {
    radiosity::Material material{given.name, given.reflectance.value_or(radiosity::Color(options.reflectance)), given.emission};
    open += given.reflectance ? 0 : 1;
    material.reflectance = glm::max(material.reflectance, radiosity::Color(0.0));
    if (radiosity::is_black(material.reflectance) && !radiosity::is_black(given.mirror)) {
      material.reflectance = glm::max(given.mirror, radiosity::Color(0.0));
      ++mirrors;
    }
    const double most = radiosity::brightest(material.reflectance);
    bright += most > most_reflectance ? 1 : 0;
    material.reflectance *= most > most_reflectance ? white_paint / most : 1.0;
    materials.push_back(std::move(material));
  }
  if (open > 0) {
    notes.push_back(counted(open, "material has", "materials have") + " no reflectance: " + formatted("%g", options.reflectance) +
                    " (--reflectance)");
  }
  if (mirrors > 0) {
    notes.push_back(counted(mirrors, "material reflects", "materials reflect") +
                    " as a mirror alone: taken as paint of the colour of the mirror");
  }
  if (bright > 0) {
    notes.push_back(counted(bright, "material reflects", "materials reflect") + " more than " + formatted("%g", most_reflectance) +
                    ", as no surface does: darkened to " + formatted("%g", white_paint) + ", like white paint");
  }
  return materials;
}

// A lamp that is not a material of the file is a fault, because otherwise its absence would not be noticed.
void set_lamps(Materials& materials, const std::vector<Lamp>& lamps, std::vector<std::string>& faults) {
  for (const Lamp& lamp : lamps) {
    bool found = false;
    for (radiosity::Material& material : materials) {
      if (material.name != lamp.material) { continue; }
      found = true;
      material.emission = radiosity::Color(lamp.exitance);
    }
    if (found) { continue; }
    const std::vector<std::string_view> known = names_of(materials);
    faults.push_back("--lamp " + lamp.material + ": the file has no such material; it has " + list_of(known) +
                     suggestion(lamp.material, known));
  }
}

// Is this the name of what shines, such as "light", "Area Light.001" or "mat_lamp"? Words for other things do not count, such as "light
// wood", or "wall light", which may be a colour.
bool means_lamp(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (small >= 'a' && small <= 'z') { letters += small; }
  }
  std::string_view word = letters;
  for (const std::string_view general : {"material", "mat"}) {
    if (word.starts_with(general)) { word.remove_prefix(general.size()); }
    if (word.ends_with(general)) { word.remove_suffix(general.size()); }
  }
  if (word.ends_with('s')) { word.remove_suffix(1); }
  constexpr std::array<std::string_view, 12> words{"light",        "lamp",        "bulb",    "lightbulb", "arealight", "lightsource",
                                                   "ceilinglight", "ceilinglamp", "emitter", "emission",  "emissive",  "luminaire"};
  return std::ranges::find(words, word) != words.end();
}

// Where nothing shines, those materials do whose names say so, unless all surfaces have such a name.
void set_lamps_by_name(Materials& materials, const Model& model, std::vector<std::string>& notes) {
  const auto dark = [](const radiosity::Material& material) { return radiosity::is_black(material.emission); };
  if (!model.lights.empty() || !std::ranges::all_of(materials, dark)) { return; }
  std::vector<bool> used(materials.size(), false);
  for (const std::uint32_t m : model.material) { used[m] = true; }
  for (const radiosity::SceneObject& object : model.objects) {
    for (const std::uint32_t m : object.material) { used[m] = true; }
  }
  std::vector<radiosity::Material*> lamps;
  std::size_t others = 0;
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (used[m] && means_lamp(materials[m].name)) {
      lamps.push_back(&materials[m]);
    } else if (used[m]) {
      ++others;
    }
  }
  if (lamps.empty() || others == 0) { return; }
  const double exitance = Lamp{}.exitance;
  for (radiosity::Material* const lamp : lamps) { lamp->emission = radiosity::Color(exitance); }
  notes.push_back("nothing shines in this file: what is called " + mesh_file::shown(lamps.front()->name) + " does now, with " +
                  formatted("%g", exitance) + " W/m2 (--lamp MATERIAL=W/m2; with 0 it does not)");
}

}  // namespace

std::vector<std::string_view> names_of(const std::vector<radiosity::Material>& materials) {
  std::vector<std::string_view> list;
  for (const radiosity::Material& material : materials) {
    if (list.size() < 1000 && !contains(list, material.name)) { list.push_back(material.name); }
  }
  return list;
}

std::vector<radiosity::Material> scene_materials(const Model& model, const ModelOptions& options, bool lamps_by_name,
                                                 std::vector<std::string>& notes, std::vector<std::string>& faults) {
  Materials materials = with_reflectances(model, options, notes);
  set_lamps(materials, options.lamps, faults);
  if (lamps_by_name && options.lamps.empty()) { set_lamps_by_name(materials, model, notes); }
  return materials;
}

}  // namespace apps
