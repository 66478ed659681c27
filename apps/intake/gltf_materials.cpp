// SPDX-License-Identifier: MIT
#include "apps/intake/gltf_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "apps/intake/texture.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake {
namespace {

// The pictures of a file: each is read once.
class GltfPictures {
 public:
  GltfPictures(const JsonValue& root, GltfData& data, Notes& notes) : root_(root), data_(data), notes_(notes) {}

  // The mean colour of the picture of a texture; nothing when it cannot be read, which is noted.
  [[nodiscard]] std::optional<radiosity::Color> mean(const JsonValue& texture, const std::string& factor, const std::string& material) {
    const auto image = root_["textures"][texture["index"].index().value_or(nowhere)]["source"].index();
    std::optional<radiosity::Color> mean;
    if (image) {
      const auto [known, is_new] = means_.emplace(*image, std::nullopt);
      if (is_new) {
        if (const auto bytes = data_.picture(*image)) { known->second = mean_color(*bytes); }
      }
      mean = known->second;
    }
    notes_.add(mean ? "pictures on surfaces count with their mean colour"
                    : "textures are not read: the " + factor + " factor stands for the picture",
               "in " + mesh_file::shown(material));
    return mean;
  }

 private:
  static constexpr std::size_t nowhere = ~std::size_t{0};

  const JsonValue& root_;
  GltfData& data_;
  Notes& notes_;
  std::map<std::size_t, std::optional<radiosity::Color>> means_;
};

}  // namespace

std::vector<ModelMaterial> read_gltf_materials(const JsonValue& root, GltfData& data, Notes& notes) {
  std::vector<ModelMaterial> materials;
  GltfPictures pictures(root, data, notes);
  for (const JsonValue& given : root["materials"].items()) {
    ModelMaterial material;
    material.name = given["name"].string();
    if (material.name.empty()) { material.name = "material" + std::to_string(materials.size()); }
    const JsonValue &extensions = given["extensions"], &glossy = extensions["KHR_materials_pbrSpecularGlossiness"];
    const JsonValue& base = glossy ? glossy : given["pbrMetallicRoughness"];
    const auto color = array_of<3>(base[glossy ? "diffuseFactor" : "baseColorFactor"]).value_or(std::array{1.0, 1.0, 1.0});
    const JsonValue& picture = base[glossy ? "diffuseTexture" : "baseColorTexture"];
    const auto mean = picture ? pictures.mean(picture, "base colour", material.name) : std::nullopt;
    // A factor of 1 1 1 under a picture that is not known says nothing about the picture.
    if (!picture || mean || color != std::array{1.0, 1.0, 1.0}) {
      if (base || given["emissiveFactor"]) {
        material.reflectance = mean.value_or(radiosity::Color(1.0)) * radiosity::Color(color[0], color[1], color[2]);
      }
    }
    const auto emissive = array_of<3>(given["emissiveFactor"]).value_or(std::array{0.0, 0.0, 0.0});
    const double strength = extensions["KHR_materials_emissive_strength"]["emissiveStrength"].number(1.0);
    for (int i = 0; i < 3; ++i) {
      material.emission[i] = std::max(0.0, std::numbers::pi * strength * emissive[static_cast<std::size_t>(i)]);
      if (!std::isfinite(material.emission[i])) { material.emission[i] = 0.0; }
    }
    if (given["emissiveTexture"] && !radiosity::is_black(material.emission)) {
      material.emission *= pictures.mean(given["emissiveTexture"], "emissive", material.name).value_or(radiosity::Color(1.0));
    }
    if (extensions["KHR_materials_unlit"]) {
      notes.add("unlit materials are taken as paint of their colour", "in " + mesh_file::shown(material.name));
    }
    if (extensions["KHR_materials_transmission"] || given["alphaMode"].string() == "BLEND") {
      notes.add("materials that let light through are taken as opaque", "in " + mesh_file::shown(material.name));
    }
    material.two_sided = given["doubleSided"].boolean();
    materials.push_back(std::move(material));
  }
  return materials;
}

}  // namespace apps::intake
