// SPDX-License-Identifier: MIT
#include "apps/intake/obj_materials.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <unordered_map>

#include "apps/intake/texture.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake {
namespace {

using mesh_file::Lines;

// The three numbers of "Kd r g b"; one alone stands for all. Nothing when it is a spectral curve, CIE XYZ or no number.
std::optional<radiosity::Color> color(const Lines& lines) {
  radiosity::Color c{0.0};
  const std::size_t given = lines.words().size() - 1;
  if (given != 1 && given != 3) { return std::nullopt; }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = mesh_file::to_number(lines.words()[given == 1 ? 1 : i + 1]);
    if (!value || *value < 0.0) { return std::nullopt; }
    c[static_cast<int>(i)] = *value;
  }
  return c;
}

// The pictures of a library: each is read once.
class ObjPictures {
 public:
  explicit ObjPictures(const SideFile& side_file) : side_file_(side_file) {}

  // Of what stands behind map_Kd: options, each with numbers or words, then a name.
  [[nodiscard]] std::optional<radiosity::Color> mean(const Lines& lines) {
    std::string name(lines.words()[1].starts_with('-') ? lines.words().back() : lines.rest());
    std::replace(name.begin(), name.end(), '\\', '/');
    const auto [known, is_new] = means_.emplace(name, std::nullopt);
    std::string fault;
    if (is_new) {
      if (const auto bytes = side_file_(name, fault)) { known->second = mean_color(*bytes); }
    }
    return known->second;
  }

 private:
  const SideFile& side_file_;
  std::unordered_map<std::string, std::optional<radiosity::Color>> means_;
};

}  // namespace

void read_obj_materials(const std::string& library, const SideFile& side_file, std::vector<ModelMaterial>& materials, Notes& notes) {
  std::string fault;
  const auto text = side_file(library, fault);
  if (!text) { return notes.add("the materials in " + mesh_file::shown(library) + " are not known: it " + fault); }
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < materials.size(); ++i) { index.emplace(materials[i].name, i); }
  ModelMaterial unused;
  ModelMaterial* material = &unused;
  ObjPictures pictures(side_file);
  std::unordered_map<ModelMaterial*, std::array<std::optional<radiosity::Color>, 2>> means;  // of Kd and Ke, whichever comes first
  Lines lines(*text, true, true);
  while (lines.next()) {
    const std::string_view word = lines.words()[0];
    const std::string place = "at " + library + ":" + std::to_string(lines.line());
    const bool bare = lines.words().size() < 2;
    if (word == "newmtl") {
      const auto found = bare ? index.end() : index.find(lines.rest());
      material = found == index.end() ? &unused : &materials[found->second];
    } else if (bare || material == &unused) {
      continue;
    } else if (word == "Kd" || word == "Ke") {
      const auto value = color(lines);
      if (!value) {
        notes.add("expected one or three numbers from 0 on after " + std::string(word) + ": passed over", place);
      } else if (word == "Kd") {
        material->reflectance = *value;
      } else {
        material->emission = std::numbers::pi * *value;
      }
    } else if (word == "map_Kd" || word == "map_Ke") {
      const auto mean = pictures.mean(lines);
      if (mean) { means[material][word == "map_Kd" ? 0 : 1] = mean; }
      notes.add(mean ? "pictures on surfaces count with their mean colour"
                     : "textures are not read: " + std::string(word == "map_Kd" ? "Kd" : "Ke") + " stands for the picture",
                place);
    } else if (word == "d" || word == "Tr") {
      const auto value = mesh_file::to_number(lines.words().back());
      if (value && *value != (word == "d" ? 1.0 : 0.0)) { notes.add("materials that let light through are taken as opaque", place); }
    }
  }
  // A colour of 0 beside a picture is what programs write that know no factor.
  for (const auto& [of, mean] : means) {
    if (mean[0]) {
      of->reflectance = radiosity::is_black(of->reflectance.value_or(radiosity::Color(0.0))) ? *mean[0] : *of->reflectance * *mean[0];
    }
    if (mean[1]) { of->emission = radiosity::is_black(of->emission) ? std::numbers::pi * *mean[1] : of->emission * *mean[1]; }
  }
}

}  // namespace apps::intake
