// SPDX-License-Identifier: MIT
// glTF 2.0, as text (.gltf) and as binary (.glb): nodes with their matrices, triangles, morphs and skins in the pose of the file,
// materials, cameras, lights; also where Draco or meshopt compresses them. A file that requires an unknown extension is not refused: all
// geometry that can be read is read.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include "apps/bytes.hpp"
#include "apps/intake/gltf_data.hpp"
#include "apps/intake/gltf_deform.hpp"
#include "apps/intake/gltf_looks.hpp"
#include "apps/intake/gltf_nodes.hpp"
#include "apps/intake/json_reader.hpp"
#include "apps/intake/model.hpp"
#include "apps/mesh_file/reading.hpp"
#include "apps/text.hpp"

namespace apps::intake {
namespace {

constexpr std::size_t most_polygons = 20'000'000;  // over all uses of all meshes

class GltfReader {
 public:
  // `text_begin`: position of the text in a GLB; nothing for a text file.
  GltfReader(std::string_view text, std::optional<std::string_view> binary, std::optional<std::size_t> text_begin,
             const SideFile& side_file)
      : text_(text), text_begin_(text_begin), binary_(binary), side_file_(side_file) {}

  ModelResult run() {
    JsonFault fault;
    const auto root = parse_json(text_, fault);
    if (!root) {
      error(fault.offset, fault.sentence);
      return take();
    }
    root_ = &*root;
    if (!(*root)["asset"] || !(*root)["asset"]["version"].string().starts_with("2.")) {
      error(root->offset(), "expected glTF 2.0, whose 'asset' has the version 2.0");
      return take();
    }
    GltfData data(*root, binary_, side_file_);
    data_ = &data;
    model_.materials = read_gltf_materials(*root, data, colors_, notes_);
    default_material_ = static_cast<std::uint32_t>(model_.materials.size());
    nodes();
    if (errors_.count() == 0 && model_.polygons() == 0) { error(root->offset(), "the scene of this file has no triangles" + why_); }
    if (errors_.count() == 0) { colors_.apply(model_, notes_); }
    model_.notes = notes_.take();
    return take();
  }

 private:
  void error(std::size_t offset, std::string sentence) {
    if (text_begin_) { return errors_.add({0, static_cast<std::uint32_t>(*text_begin_ + offset + 1)}, std::move(sentence)); }
    errors_.add(place_of(text_, offset), std::move(sentence));
  }
  ModelResult take() { return read_result(std::move(model_), errors_); }

  // Visits the nodes of the scene or, if none is named, all nodes without a parent. Each node has one parent, so it is visited once.
  void nodes() {
    const JsonValue &nodes = (*root_)["nodes"], &scenes = (*root_)["scenes"];
    struct Open {
      std::size_t node;
      glm::dmat4 parent;
      bool hidden = false;  // with its parent
    };
    std::vector<Open> open;
    std::vector<bool> met(nodes.items().size(), false);
    const auto push = [&](const JsonValue& index, const glm::dmat4& parent, bool hidden) {
      const auto node = index.index();
      if (!node || *node >= met.size()) {
        return error(index.offset(), "there is no such node; the file has " + std::to_string(met.size()));
      }
      if (met[*node]) { return notes_.add("nodes that stand in several places are used once", "node " + std::to_string(*node)); }
      met[*node] = true;
      open.push_back({*node, parent, hidden});
    };
    const JsonValue& scene = scenes[(*root_)["scene"].index().value_or(0)];
    if (scene) {
      for (std::size_t i = scene["nodes"].items().size(); i-- > 0;) { push(scene["nodes"][i], glm::dmat4(1.0), false); }
    } else {
      std::vector<bool> child(met.size(), false);
      for (const JsonValue& node : nodes.items()) {
        for (const JsonValue& index : node["children"].items()) {
          if (const auto i = index.index(); i && *i < child.size()) { child[*i] = true; }
        }
      }
      for (std::size_t i = met.size(); i-- > 0;) {
        if (child[i]) { continue; }
        met[i] = true;
        open.push_back({i, glm::dmat4(1.0)});
      }
    }
    while (!open.empty() && !errors_.full()) {
      const auto [index, parent, below_hidden] = open.back();
      open.pop_back();
      const JsonValue& node = nodes[index];
      const glm::dmat4 matrix = parent * gltf_matrix(node);
      const bool hidden = below_hidden || !node["extensions"]["KHR_node_visibility"]["visible"].boolean(true);
      if (hidden && node["mesh"]) { pass_over("hidden nodes are left out", "node " + std::to_string(index)); }
      if (!hidden && node["mesh"]) { instances(node, matrix, index); }
      if (node["camera"]) { camera(node, matrix); }
      if (const JsonValue& named = node["extensions"]["KHR_lights_punctual"]["light"]; named && !hidden) { light(named, matrix); }
      for (std::size_t i = node["children"].items().size(); i-- > 0;) { push(node["children"][i], matrix, hidden); }
    }
  }

  // EXT_mesh_gpu_instancing: places a node's mesh once per element of accessors with translations, rotations and scales.
  void instances(const JsonValue& node, const glm::dmat4& matrix, std::size_t index) {
    const JsonValue& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    if (!attributes) { return mesh(node, matrix, index); }
    std::string fault;
    std::optional<std::size_t> count;
    const auto of = [&](std::string_view name, std::size_t components) {
      auto numbers = attributes[name] ? data_->numbers(attributes[name], components, fault) : std::nullopt;
      if (numbers) { count = std::min(count.value_or(nowhere), numbers->size() / components); }
      return numbers;
    };
    const auto moved = of("TRANSLATION", 3), turned = of("ROTATION", 4), scaled = of("SCALE", 3);
    if (!fault.empty()) { return error(attributes.offset(), fault); }
    if (count.value_or(0) > max_objects) {
      return error(attributes.offset(), "the node has more than " + std::to_string(max_objects) + " instances");
    }
    for (std::size_t i = 0; i < count.value_or(0) && !errors_.full() && !too_large_; ++i) {
      const auto at = [&](const auto& numbers, std::size_t components, std::size_t k, double otherwise) {
        return numbers ? (*numbers)[components * i + k] : otherwise;
      };
      const glm::dquat turn(at(turned, 4, 3, 1.0), at(turned, 4, 0, 0.0), at(turned, 4, 1, 0.0), at(turned, 4, 2, 0.0));
      const glm::dvec3 scale(at(scaled, 3, 0, 1.0), at(scaled, 3, 1, 1.0), at(scaled, 3, 2, 1.0));
      const glm::dvec3 move(at(moved, 3, 0, 0.0), at(moved, 3, 1, 0.0), at(moved, 3, 2, 0.0));
      mesh(node, matrix * gltf_placed(move, turn, scale), index);
    }
  }

  void mesh(const JsonValue& node, const glm::dmat4& matrix, std::size_t index) {
    const JsonValue& mesh = (*root_)["meshes"][node["mesh"].index().value_or(nowhere)];
    if (!mesh) { return error(node["mesh"].offset(), "there is no such mesh"); }
    std::string name = !node["name"].string().empty() ? node["name"].string() : mesh["name"].string();
    if (name.empty()) { name = "node" + std::to_string(index); }
    const auto group = static_cast<std::uint32_t>(model_.groups.size());
    model_.groups.push_back(std::move(name));
    std::size_t number = 0;
    for (const JsonValue& primitive : mesh["primitives"].items()) {
      if (errors_.full() || too_large_) { return; }
      model_.begin_part("meshes[" + std::to_string(*node["mesh"].index()) + "].primitives[" + std::to_string(number++) + "] of nodes[" +
                        std::to_string(index) + "] " + mesh_file::shown(model_.groups[group]));
      triangles(primitive, mesh, node, matrix, group);
    }
  }

  // The matrix of each vertex of a skinned primitive; nothing for others.
  [[nodiscard]] std::optional<std::vector<glm::dmat4>> skin_matrices(const JsonValue& primitive, const JsonValue& skin,
                                                                     std::size_t vertices, std::string& fault, const std::string& place) {
    if (!skin) { return std::nullopt; }
    if (in_scene_.empty()) { in_scene_ = gltf_scene_matrices((*root_)["nodes"]); }
    return gltf_skin((*root_)["skins"][skin.index().value_or(nowhere)], *data_, primitive, in_scene_, vertices, fault, notes_, place);
  }

  // The indices of the triangle that begins at index i of a list (mode 4), a strip (5) or a fan (6).
  static std::array<std::size_t, 3> triangle(std::size_t mode, std::size_t i, bool mirrored) {
    const bool turned = (mode == 5 && i % 2 == 1) != mirrored;
    return {mode == 6 ? 0 : i, turned ? i + 2 : i + 1, turned ? i + 1 : i + 2};
  }

  void triangles(const JsonValue& primitive, const JsonValue& mesh, const JsonValue& node, const glm::dmat4& matrix, std::uint32_t group) {
    const std::string place = "in " + mesh_file::shown(model_.groups[group]);
    std::size_t mode = primitive["mode"] ? primitive["mode"].index().value_or(nowhere) : 4;
    if (mode < 4 || mode > 6) { return pass_over("points and lines have no surface: left out", place); }
    if (!primitive["attributes"]["POSITION"]) {
      return pass_over("primitives without positions are left out: there is no such accessor", place);
    }
    std::string fault;
    const auto unpacked = data_->unpack(primitive, fault);
    auto positions = unpacked ? data_->numbers(primitive["attributes"]["POSITION"], 3, fault) : std::nullopt;
    const auto given = positions && primitive["indices"] ? data_->numbers(primitive["indices"], 1, fault) : std::nullopt;
    if (!fault.empty()) { return error(primitive.offset(), fault); }
    if (*unpacked) { mode = 4; }  // a compressed mesh is a list of triangles
    const auto material = primitive["material"].index();
    if (primitive["material"] && (!material || *material >= default_material_)) {
      return error(primitive["material"].offset(), "there is no such material");
    }
    const auto first = static_cast<std::uint32_t>(model_.positions.size());
    const std::size_t vertices = positions->size() / 3, count = given ? given->size() : vertices;
    if (model_.positions.size() + vertices > 3 * most_polygons || model_.polygons() + count > most_polygons) {
      too_large_ = true;
      return error(primitive.offset(), "the scene has more than " + std::to_string(most_polygons) + " triangles");
    }
    gltf_morph(node, mesh, primitive, *data_, *positions, notes_, place);
    const auto skinned = skin_matrices(primitive, node["skin"], vertices, fault, place);
    const auto to_scene = [&](std::size_t v) -> const glm::dmat4& { return skinned ? (*skinned)[v] : matrix; };
    if (!fault.empty()) { return error(primitive.offset(), fault); }
    for (std::size_t v = 0; v < vertices; ++v) {
      model_.positions.emplace_back(to_scene(v) * glm::dvec4((*positions)[3 * v], (*positions)[3 * v + 1], (*positions)[3 * v + 2], 1.0));
    }
    const auto vertex = [&](std::size_t i) { return given ? (*given)[i] : static_cast<double>(i); };
    for (std::size_t i = 0; i < count; ++i) {
      if (!(vertex(i) >= 0.0 && vertex(i) < static_cast<double>(vertices))) {
        return error(primitive.offset(), "an index names vertex " + formatted("%.0f", vertex(i)) + " of " + std::to_string(vertices));
      }
    }
    if (!material && model_.materials.size() == default_material_) {
      model_.materials.push_back({"default", {}, radiosity::Color(0.0), false});
    }
    const bool mirrored = vertices > 0 && glm::determinant(glm::dmat3(to_scene(0))) < 0.0;
    const std::vector<glm::dvec2> places = gltf_texture_places(*root_, *data_, primitive, material, vertices);
    const std::vector<double> paint = gltf_vertex_colors(*root_, *data_, primitive, vertices, notes_, place);
    const std::size_t step = mode == 4 ? 3 : 1;
    for (std::size_t i = 0; i + 2 < count; i += step) {
      const auto [a, b, c] = triangle(mode, i, mirrored);
      const auto at = [&](std::size_t index) { return first + static_cast<std::uint32_t>(vertex(index)); };
      const std::array<std::uint32_t, 3> corners{at(a), at(b), at(c)};
      model_.polygon(corners, static_cast<std::uint32_t>(material.value_or(default_material_)), group);
      if (!places.empty()) {
        colors_.lies_at(model_, std::array{places[corners[0] - first], places[corners[1] - first], places[corners[2] - first]});
      }
      if (!paint.empty()) {
        radiosity::Color sum(0.0);
        for (const std::uint32_t corner : corners) {
          for (int k = 0; k < 3; ++k) { sum[k] += paint[3 * (corner - first) + static_cast<std::size_t>(k)] / 3.0; }
        }
        colors_.tint(model_, sum);
      }
    }
  }

  void pass_over(const std::string& sentence, const std::string& place) {
    notes_.add(sentence, place);
    why_ = "; " + sentence;
  }

  // KHR_lights_punctual: intensities in candela are taken as W/sr, as for materials, and so those in lux as W/m2.
  void light(const JsonValue& named, const glm::dmat4& matrix) {
    const JsonValue& given = (*root_)["extensions"]["KHR_lights_punctual"]["lights"][named.index().value_or(nowhere)];
    if (!given) { return error(named.offset(), "there is no such light"); }
    const std::string& type = given["type"].string();
    radiosity::Color color(1.0);
    for (int k = 0; k < 3; ++k) { color[k] = given["color"][static_cast<std::size_t>(k)].number(1.0); }
    const radiosity::Color intensity = glm::clamp(given["intensity"].number(1.0) * color, radiosity::Color(0.0), radiosity::Color(1e6));
    const auto kind = type == "directional" ? ModelLight::Kind::sun : type == "spot" ? ModelLight::Kind::spot : ModelLight::Kind::point;
    const double inner = given["spot"]["innerConeAngle"].number(0.0);
    const double outer = given["spot"]["outerConeAngle"].number(0.25 * std::numbers::pi);
    const bool ends = kind != ModelLight::Kind::sun && given["range"];
    model_.lights.push_back({kind, glm::dvec3(matrix[3]), intensity, true, -glm::dvec3(matrix[2]), inner, outer});
    model_.lights.back().fades_otherwise = ends;
  }

  void camera(const JsonValue& node, const glm::dmat4& matrix) {
    const JsonValue& given = (*root_)["cameras"][node["camera"].index().value_or(nowhere)];
    if (!given) { return error(node["camera"].offset(), "there is no such camera"); }
    const JsonValue& lens = given["perspective"];
    const std::string& own = given["name"].string();
    radiosity::Camera camera;
    camera.name = !own.empty()                     ? own
                  : !node["name"].string().empty() ? node["name"].string()
                                                   : "camera" + std::to_string(model_.cameras.size());
    if (!lens) { return notes_.add("cameras without perspective are passed over", mesh_file::shown(camera.name)); }
    camera.eye = glm::dvec3(matrix[3]);
    camera.forward = -glm::dvec3(matrix[2]);
    camera.up = glm::dvec3(matrix[1]);
    const double aspect = lens["aspectRatio"].number(4.0 / 3.0);
    camera.field_of_view = 2.0 * std::atan(aspect * std::tan(0.5 * lens["yfov"].number(0.7))) * 180.0 / std::numbers::pi;
    if (lens["aspectRatio"] && aspect > 0.05 && aspect < 20.0) {
      camera.size = radiosity::PictureSize{static_cast<std::uint32_t>(std::lround(600.0 * aspect)), 600};
    }
    if (usable(camera)) { return model_.cameras.push_back(std::move(camera)); }
    notes_.add("cameras that see nothing are passed over", mesh_file::shown(camera.name));
  }

  std::string_view text_;
  std::optional<std::size_t> text_begin_;
  std::optional<std::string_view> binary_;
  const SideFile& side_file_;
  const JsonValue* root_ = nullptr;
  GltfData* data_ = nullptr;
  std::vector<glm::dmat4> in_scene_;  // of all nodes, once a skin asks for them
  std::uint32_t default_material_ = 0;
  std::string why_;
  bool too_large_ = false;
  Model model_;
  PolygonColors colors_;
  Notes notes_;
  Errors errors_;
};

ModelResult read_gltf(std::string_view bytes, const SideFile& side_file) {
  return GltfReader(bytes, std::nullopt, std::nullopt, side_file).run();
}

// A GLB has a header of twelve bytes and then chunks: first the text, then the binary data.
ModelResult read_glb(std::string_view bytes, const SideFile& side_file) {
  const auto refuse = [](std::size_t at, const std::string& sentence) {
    Errors errors;
    errors.add({0, static_cast<std::uint32_t>(at + 1)}, sentence);
    return ModelResult{errors.take(), std::nullopt};
  };
  const auto word_at = [&](std::size_t at) { return bits_at(bytes, at, 4); };
  constexpr std::uint32_t json = 0x4e4f534a, bin = 0x004e4942;
  if (!bytes.starts_with("glTF")) { return refuse(0, "expected a binary glTF file, which begins with the letters glTF"); }
  if (bytes.size() < 20) { return refuse(bytes.size(), "the file ends within its header"); }
  if (word_at(4) != 2) { return refuse(4, "expected version 2 of glTF, found version " + std::to_string(word_at(4))); }
  const std::size_t length = word_at(12);
  if (word_at(16) != json) { return refuse(16, "expected the text (JSON) as the first chunk"); }
  if (length > bytes.size() - 20) { return refuse(12, "the file ends within its text; it has " + std::to_string(bytes.size()) + " bytes"); }
  std::optional<std::string_view> binary;
  const auto is_binary = [&](std::size_t at) { return at + 8 <= bytes.size() && word_at(at + 4) == bin; };
  const std::size_t behind = 20 + length;  // chunks begin at multiples of 4; some writers do not include the padding in the length
  const std::size_t next = is_binary(behind) ? behind : (behind + 3) / 4 * 4;
  if (is_binary(next)) {
    if (word_at(next) > bytes.size() - next - 8) {
      return refuse(next, "the file ends within its binary chunk; it has " + std::to_string(bytes.size()) + " bytes");
    }
    binary = bytes.substr(next + 8, word_at(next));
  }
  return GltfReader(bytes.substr(20, length), binary, 20, side_file).run();
}

bool begins_gltf(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != bytes.npos && bytes[first] == '{' && bytes.substr(0, 1 << 16).find("\"asset\"") != bytes.npos;
}
bool begins_glb(std::string_view bytes) { return bytes.starts_with("glTF"); }

}  // namespace

constinit const ModelFormat gltf{".gltf", "glTF", UpAxis::y, begins_gltf, read_gltf};
constinit const ModelFormat glb{".glb", "binary glTF", UpAxis::y, begins_glb, read_glb};

}  // namespace apps::intake
