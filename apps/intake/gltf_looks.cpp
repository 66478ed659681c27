// SPDX-License-Identifier: MIT
#include "apps/intake/gltf_looks.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <numbers>

#include "apps/intake/texture.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake {
namespace {

// The colour texture of a material, or else its emission texture; a null value if it has neither.
const JsonValue& color_texture(const JsonValue& material) {
  const JsonValue& glossy = material["extensions"]["KHR_materials_pbrSpecularGlossiness"];
  const JsonValue& base = (glossy ? glossy : material["pbrMetallicRoughness"])[glossy ? "diffuseTexture" : "baseColorTexture"];
  return base ? base : material["emissiveTexture"];
}

// Do both textures use the same texture coordinates?
bool lie_alike(const JsonValue& a, const JsonValue& b) {
  const auto plain = [](const JsonValue& texture) { return texture["texCoord"].index().value_or(0) == 0 && !texture["extensions"]; };
  return &a == &b || (plain(a) && plain(b));
}

class MaterialReader {
 public:
  MaterialReader(const JsonValue& root, GltfData& data, PolygonColors& colors, Notes& notes)
      : root_(root), data_(data), colors_(colors), notes_(notes) {}

  // The material with this number in the file.
  ModelMaterial read(const JsonValue& given, std::uint32_t number) {
    ModelMaterial material;
    material.name = given["name"].string();
    if (material.name.empty()) { material.name = "material" + std::to_string(number); }
    const std::string place = "in " + mesh_file::shown(material.name);
    set_reflectance(material, given, number, place);
    set_emission(material, given, number, place);
    if (given["extensions"]["KHR_materials_unlit"]) { notes_.add("unlit materials are taken as paint of their colour", place); }
    material.opacity = opacity_of(given);
    if (material.opacity >= least_opacity && (transmission(given) > 0.0 || given["alphaMode"].string() == "BLEND")) {
      notes_.add("materials that let light through are taken as opaque", place);
    }
    material.two_sided = given["doubleSided"].boolean();
    if (draws_outlines(material)) {
      notes_.add("dark shells that draw outlines, around things and turned inside out, are taken as panes", place);
      material.opacity = 0.0;
    }
    return material;
  }

 private:
  // Is it one of the shells that draw the outlines of cartoons? One sees them only behind the things that they enclose, but in light they
  // would hide these.
  static bool draws_outlines(const ModelMaterial& material) {
    constexpr double dark = 0.1;
    std::string small = material.name;
    std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return !material.two_sided && small.find("outline") != std::string::npos && material.reflectance &&
           radiosity::brightest(*material.reflectance) < dark && radiosity::is_black(material.emission);
  }

  // The share of light that passes through a surface without being refracted twice, as through a body of glass (KHR_materials_volume).
  static double transmission(const JsonValue& given) {
    return given["extensions"]["KHR_materials_transmission"]["transmissionFactor"].number(0.0);
  }

  // A picture counts with its most opaque pixel, because the leaves of a tree, for example, are opaque in parts.
  double opacity_of(const JsonValue& given) {
    const JsonValue &extensions = given["extensions"], &glossy = extensions["KHR_materials_pbrSpecularGlossiness"];
    const JsonValue& base = glossy ? glossy : given["pbrMetallicRoughness"];
    double alpha = array_of<4>(base[glossy ? "diffuseFactor" : "baseColorFactor"]).value_or(std::array{1.0, 1.0, 1.0, 1.0})[3];
    const JsonValue& texture = base[glossy ? "diffuseTexture" : "baseColorTexture"];
    if (const auto picture = texture ? read_picture(texture) : nullptr) { alpha *= picture->most_opaque(); }
    const std::string& mode = given["alphaMode"].string();
    if (mode == "MASK") { return alpha < given["alphaCutoff"].number(0.5) ? 0.0 : 1.0; }
    double opacity = mode == "BLEND" ? std::clamp(alpha, 0.0, 1.0) : 1.0;
    const bool body = extensions["KHR_materials_volume"]["thicknessFactor"].number(0.0) > 0.0;
    const bool in_parts(extensions["KHR_materials_transmission"]["transmissionTexture"]);
    if (!body && !in_parts) { opacity *= 1.0 - std::clamp(transmission(given), 0.0, 1.0); }
    return opacity;
  }

  void set_reflectance(ModelMaterial& material, const JsonValue& given, std::uint32_t number, const std::string& place) {
    const JsonValue& glossy = given["extensions"]["KHR_materials_pbrSpecularGlossiness"];
    const JsonValue& base = glossy ? glossy : given["pbrMetallicRoughness"];
    const auto color = array_of<3>(base[glossy ? "diffuseFactor" : "baseColorFactor"]).value_or(std::array{1.0, 1.0, 1.0});
    const JsonValue& picture = base[glossy ? "diffuseTexture" : "baseColorTexture"];
    const auto paint = picture ? picture_of(picture, "base colour", place) : nullptr;
    colors_.picture(number, PolygonColors::Of::reflectance, paint, place);
    // If the picture is not readable, a factor of 1 1 1 says nothing about the colour.
    if (!picture || paint || color != std::array{1.0, 1.0, 1.0}) {
      if (base || given["emissiveFactor"]) { material.reflectance = radiosity::Color(color[0], color[1], color[2]); }
    }
  }

  void set_emission(ModelMaterial& material, const JsonValue& given, std::uint32_t number, const std::string& place) {
    const auto emissive = array_of<3>(given["emissiveFactor"]).value_or(std::array{0.0, 0.0, 0.0});
    const double strength = given["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].number(1.0);
    for (int i = 0; i < 3; ++i) {
      material.emission[i] = std::max(0.0, std::numbers::pi * strength * emissive[static_cast<std::size_t>(i)]);
      if (!std::isfinite(material.emission[i])) { material.emission[i] = 0.0; }
    }
    const JsonValue& texture = given["emissiveTexture"];
    if (!texture || radiosity::is_black(material.emission)) { return; }
    const auto glow = read_picture(texture);
    if (!glow) {  // most of such a picture is usually black
      material.emission = radiosity::Color(0.0);
      return notes_.add("surfaces whose emissive picture is not read do not shine (--lamp MATERIAL)", place);
    }
    if (lie_alike(texture, color_texture(given))) {
      colors_.picture(number, PolygonColors::Of::emission, glow, place);
    } else {
      notes_.add("pictures on surfaces count with their mean colour", place);
      material.emission *= glow->mean();
    }
  }

  std::shared_ptr<const Picture> read_picture(const JsonValue& texture) {
    const auto image = root_["textures"][texture["index"].index().value_or(nowhere)]["source"].index();
    if (!image) { return nullptr; }
    return pictures_.of(*image, [&] {
      const auto bytes = data_.picture(*image);
      return bytes ? Picture::read(*bytes) : nullptr;
    });
  }

  // Null if it cannot be read, which is noted.
  std::shared_ptr<const Picture> picture_of(const JsonValue& texture, const std::string& factor, const std::string& place) {
    auto picture = read_picture(texture);
    if (!picture) { notes_.add("textures are not read: the " + factor + " factor stands for the picture", place); }
    return picture;
  }

  const JsonValue& root_;
  GltfData& data_;
  PolygonColors& colors_;
  Notes& notes_;
  Pictures<std::size_t> pictures_;
};

}  // namespace

std::vector<ModelMaterial> read_gltf_materials(const JsonValue& root, GltfData& data, PolygonColors& colors, Notes& notes) {
  std::vector<ModelMaterial> materials;
  MaterialReader reader(root, data, colors, notes);
  for (const JsonValue& given : root["materials"].items()) {
    materials.push_back(reader.read(given, static_cast<std::uint32_t>(materials.size())));
  }
  return materials;
}

std::vector<glm::dvec2> gltf_texture_places(const JsonValue& root, GltfData& data, const JsonValue& primitive,
                                            std::optional<std::size_t> material, std::size_t vertices) {
  if (!material) { return {}; }
  const JsonValue& texture = color_texture(root["materials"][*material]);
  if (!texture) { return {}; }
  const JsonValue& transform = texture["extensions"]["KHR_texture_transform"];
  const JsonValue& set = transform["texCoord"] ? transform["texCoord"] : texture["texCoord"];
  std::string fault;
  const auto numbers = data.numbers(primitive["attributes"]["TEXCOORD_" + std::to_string(set.index().value_or(0))], 2, fault);
  if (!numbers || numbers->size() < 2 * vertices) { return {}; }
  const auto offset = array_of<2>(transform["offset"]).value_or(std::array{0.0, 0.0});
  const auto scale = array_of<2>(transform["scale"]).value_or(std::array{1.0, 1.0});
  const double angle = transform["rotation"].number(0.0), c = std::cos(angle), s = std::sin(angle);
  std::vector<glm::dvec2> places;
  for (std::size_t v = 0; v < vertices; ++v) {
    const double x = scale[0] * (*numbers)[2 * v], y = scale[1] * (*numbers)[2 * v + 1];
    places.emplace_back(offset[0] + c * x + s * y, offset[1] - s * x + c * y);
  }
  return places;
}

std::vector<double> gltf_vertex_colors(const JsonValue& root, GltfData& data, const JsonValue& primitive, std::size_t vertices,
                                       Notes& notes, const std::string& place) {
  const JsonValue& index = primitive["attributes"]["COLOR_0"];
  if (!index) { return {}; }
  const std::string& type = root["accessors"][index.index().value_or(~std::size_t{0})]["type"].string();
  const std::size_t components = type == "VEC4" ? 4 : 3;
  std::string fault;
  const auto numbers = data.numbers(index, components, fault);
  if (!numbers || numbers->size() < components * vertices) {
    notes.add("colours of vertices cannot be read: left out", place);
    return {};
  }
  std::vector<double> colors;
  for (std::size_t v = 0; v < vertices; ++v) {
    for (std::size_t k = 0; k < 3; ++k) { colors.push_back((*numbers)[components * v + k]); }
  }
  return colors;
}

}  // namespace apps::intake
