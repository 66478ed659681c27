// SPDX-License-Identifier: MIT
#include "apps/intake/gltf_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "apps/intake/texture.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake {

std::vector<ModelMaterial> read_gltf_materials(const JsonValue& root, GltfData& data, Notes& notes) {
  std::vector<ModelMaterial> materials;
  PictureMeans<std::size_t> pictures;
  // The mean colour of the picture of a texture; nothing when it cannot be read, which is noted.
  const auto mean_of = [&](const JsonValue& texture, const std::string& factor, const std::string& material) {
    const auto image = root["textures"][texture["index"].index().value_or(~std::size_t{0})]["source"].index();
    std::optional<radiosity::Color> mean;
    if (image) {
      mean = pictures.of(*image, [&] {
        const auto bytes = data.picture(*image);
        return bytes ? mean_color(*bytes) : std::nullopt;
      });
    }
    notes.add(mean ? "pictures on surfaces count with their mean colour"
                   : "textures are not read: the " + factor + " factor stands for the picture",
              "in " + mesh_file::shown(material));
    return mean;
  };
  for (const JsonValue& given : root["materials"].items()) {
    ModelMaterial material;
    material.name = given["name"].string();
    if (material.name.empty()) { material.name = "material" + std::to_string(materials.size()); }
    const JsonValue &extensions = given["extensions"], &glossy = extensions["KHR_materials_pbrSpecularGlossiness"];
    const JsonValue& base = glossy ? glossy : given["pbrMetallicRoughness"];
    const auto color = array_of<3>(base[glossy ? "diffuseFactor" : "baseColorFactor"]).value_or(std::array{1.0, 1.0, 1.0});
    const JsonValue& picture = base[glossy ? "diffuseTexture" : "baseColorTexture"];
    const auto mean = picture ? mean_of(picture, "base colour", material.name) : std::nullopt;
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
      material.emission *= mean_of(given["emissiveTexture"], "emissive", material.name).value_or(radiosity::Color(1.0));
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
