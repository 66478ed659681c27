// SPDX-License-Identifier: MIT
// GLB (glTF 2.0, binary). COLOR_0 is the displayed colour: linear, exposed, clamped to [0, 1], on an unlit material. _RADIOSITY contains
// the light itself in W/m2. Positions are floats relative to the scene's centre, which is the translation of their nodes, so a scene far
// from the origin loses no precision; the root node rotates our vertical axis z to y. With a lightmap, a texture replaces COLOR_0.
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <brep/ears.hpp>

#include <raycast/box.hpp>

#include <radiosity/camera/tone.hpp>

#include "apps/bytes.hpp"
#include "apps/export/export_mesh.hpp"
#include "apps/json.hpp"
#include "apps/process.hpp"

namespace apps::exported {
namespace {

class Writer {
 public:
  // `coordinates`: by vertex, in the texture of the mesh; empty if it has none.
  Writer(const ExportMesh& mesh, const std::vector<glm::vec2>& coordinates, const radiosity::Tone& tone)
      : mesh_(mesh), coordinates_(coordinates), tone_(tone) {
    raycast::Box box;
    for (const ExportVertex& vertex : mesh.vertices) { box.extend(vertex.position); }
    if (mesh.vertices.empty()) { return; }
    centre_ = box.centre();
    if (box.hi != box.lo) { size_ = box.diameter(); }
  }

  std::string file() {
    for (const ExportVertex& v : mesh_.vertices) { put(binary_, glm::vec3(v.position - centre_)); }
    for (const ExportVertex& v : mesh_.vertices) { put(binary_, glm::vec3(v.normal)); }
    for (std::size_t v = 0; v < mesh_.vertices.size() && !textured(); ++v) { put(binary_, glm::vec3(tone_(mesh_.vertices[v].radiosity))); }
    for (const glm::vec2& at : coordinates_) { put(binary_, at); }
    for (const ExportVertex& v : mesh_.vertices) { put(binary_, glm::vec3(v.radiosity)); }
    for (std::size_t g = 0; g < mesh_.groups.size(); ++g) { add_indices(g); }
    if (textured()) {
      binary_ += mesh_.texture;
      binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    }
    std::string json = description();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    put(bytes, 2);
    put(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary_.size()));
    put(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    put(bytes, static_cast<std::uint32_t>(binary_.size()));
    return bytes + std::string("BIN\0", 4) + binary_;
  }

 private:
  struct Part {
    std::size_t group = 0;
    std::uint32_t first_vertex = 0, vertices = 0;
    std::size_t first_index = 0, indices = 0;
  };

  void add_indices(std::size_t g) {
    const ExportGroup& group = mesh_.groups[g];
    const bool last = g + 1 == mesh_.groups.size();
    const std::uint32_t end_face = last ? mesh_.faces() : mesh_.groups[g + 1].first_face;
    const auto end_vertex = last ? static_cast<std::uint32_t>(mesh_.vertices.size()) : mesh_.groups[g + 1].first_vertex;
    Part part{g, group.first_vertex, end_vertex - group.first_vertex, indices_, 0};
    for (std::uint32_t f = group.first_face; f < end_face; ++f) {
      const std::span<const std::uint32_t> face = mesh_.face(f);
      const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
        for (const std::size_t k : {a, b, c}) { put(binary_, face[k] - group.first_vertex); }
        part.indices += 3;
      };
      if (face.size() <= 4) {  // as shading divides a quadrilateral (radiosity/result/mesh.hpp)
        for (std::size_t k = 2; k < face.size(); ++k) { triangle(0, k - 1, k); }
        continue;
      }
      std::vector<glm::dvec3> outline;
      for (const std::uint32_t v : face) { outline.push_back(mesh_.vertices[v].position); }
      for (const auto& [a, b, c] : brep::ears(outline)) { triangle(a, b, c); }
    }
    indices_ += part.indices;
    if (part.indices > 0) { parts_.push_back(part); }
  }

  [[nodiscard]] bool textured() const { return !coordinates_.empty(); }
  // Bytes per vertex of list number `list` of the attributes POSITION, NORMAL, COLOR_0 or TEXCOORD_0, _RADIOSITY.
  [[nodiscard]] std::size_t stride(std::size_t list) const { return list == 2 && textured() ? 8 : 12; }

  void views(JsonWriter& json) const {
    std::size_t offset = 0;
    for (std::size_t list = 0; list < 4; ++list) {
      const std::size_t length = stride(list) * mesh_.vertices.size();
      json.object("buffer", 0, "byteOffset", offset, "byteLength", length, "byteStride", stride(list), "target", 34962);
      offset += length;
    }
    json.object("buffer", 0, "byteOffset", offset, "byteLength", 4 * indices_, "target", 34963);
    if (textured()) { json.object("buffer", 0, "byteOffset", offset + 4 * indices_, "byteLength", mesh_.texture.size()); }
  }

  void accessors(JsonWriter& json, const Part& part) const {
    for (std::size_t view = 0; view < 4; ++view) {
      json.open_object().fields("bufferView", view, "byteOffset", stride(view) * part.first_vertex, "componentType", 5126, "count",
                                part.vertices, "type", stride(view) == 8 ? "VEC2" : "VEC3");
      if (view == 0) {
        glm::vec3 lo(mesh_.vertices[part.first_vertex].position - centre_), hi = lo;
        for (std::uint32_t v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) {
          lo = glm::min(lo, glm::vec3(mesh_.vertices[v].position - centre_));
          hi = glm::max(hi, glm::vec3(mesh_.vertices[v].position - centre_));
        }
        json.fields("min", lo, "max", hi);
      }
      json.close();
    }
    json.object("bufferView", 4, "byteOffset", 4 * part.first_index, "componentType", 5125, "count", part.indices, "type", "SCALAR");
  }

  // A glTF camera looks along its -z axis, with y up.
  static std::array<double, 16> camera_matrix(const radiosity::Camera& camera) {
    const glm::dvec3 back = -glm::normalize(camera.forward), right = glm::normalize(glm::cross(camera.up, back)),
                     up = glm::cross(back, right);
    const glm::dvec3& e = camera.eye;
    return {right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, back.x, back.y, back.z, 0, e.x, e.y, e.z, 1};
  }

  // The root node, then the parts, then the cameras.
  void nodes(JsonWriter& json) const {
    const std::size_t parts = parts_.size(), cameras = mesh_.cameras.size();
    json.key("nodes").open_array().open_object();
    json.fields("name", "halflight");
    if (mesh_.z_up) { json.fields("rotation", std::array<double, 4>{-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}); }
    if (parts + cameras > 0) {
      json.key("children").open_array();
      for (std::size_t i = 1; i <= parts + cameras; ++i) { json.value(i); }
      json.close();
    }
    json.close();
    for (std::size_t i = 0; i < parts; ++i) { json.object("name", mesh_.groups[parts_[i].group].name, "mesh", i, "translation", centre_); }
    for (std::size_t i = 0; i < cameras; ++i) {
      json.object("name", mesh_.cameras[i].name, "camera", i, "matrix", camera_matrix(mesh_.cameras[i]));
    }
    json.close();
  }

  void cameras(JsonWriter& json) const {
    json.key("cameras").list(mesh_.cameras, [&](const radiosity::Camera& camera) {
      const radiosity::PictureSize size = camera.size.value_or(radiosity::PictureSize{});
      const double aspect = static_cast<double>(size.width) / size.height, half = std::tan(camera.field_of_view * std::acos(-1.0) / 360.0);
      json.object("name", camera.name, "type", "perspective", "perspective", [&](JsonWriter& perspective) {
        perspective.object("aspectRatio", aspect, "yfov", 2.0 * std::atan(half / aspect), "znear", 5e-3 * size_);
      });
    });
  }

  // One unlit material for everything.
  void materials(JsonWriter& json) const {
    json.key("materials").open_array().open_object();
    json.fields("name", "baked light");
    json.key("pbrMetallicRoughness").open_object();
    if (textured()) { json.key("baseColorTexture").object("index", 0); }
    json.fields("metallicFactor", 0, "roughnessFactor", 1).close();
    json.key("extensions").object("KHR_materials_unlit", [](JsonWriter& unlit) { unlit.object(); });
    json.close().close();
    if (textured()) {  // linear filters without mipmaps, in which neighbours in the atlas would be mixed
      json.key("textures").open_array().object("source", 0, "sampler", 0).close();
      json.key("samplers").open_array().object("magFilter", 9729, "minFilter", 9729, "wrapS", 33071, "wrapT", 33071).close();
      json.key("images").open_array().object("bufferView", 5, "mimeType", "image/png").close();
    }
  }

  void meshes(JsonWriter& json) const {
    json.key("meshes").open_array();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      json.open_object().fields("name", mesh_.groups[parts_[i].group].name);
      json.key("primitives").open_array().open_object();
      json.key("attributes")
          .object("POSITION", 5 * i, "NORMAL", 5 * i + 1, textured() ? "TEXCOORD_0" : "COLOR_0", 5 * i + 2, "_RADIOSITY", 5 * i + 3);
      json.fields("indices", 5 * i + 4, "material", 0).close().close().close();
    }
    json.close();
  }

  std::string description() const {
    JsonWriter json;
    json.open_object();
    json.key("asset").object("version", "2.0", "generator", std::string("halflight ") + version, "extras", [&](JsonWriter& extras) {
      extras.open_object();
      extras.fields("exposure", tone_.exposure, "tone", name(tone_.curve), textured() ? "texture" : "COLOR_0",
                    "tone of radiosity / pi * exposure, linear, clamped to [0, 1]", "_RADIOSITY", "W/m2");
      if (textured()) { extras.fields("radiance", mesh_.texture_name); }
      extras.close();
    });
    json.key("extensionsUsed").open_array().string("KHR_materials_unlit").close();
    json.fields("scene", 0);
    json.key("scenes").open_array().open_object();
    json.key("nodes").open_array().value(0).close().close().close();
    nodes(json);
    if (!mesh_.cameras.empty()) { cameras(json); }
    if (!parts_.empty()) {
      materials(json);
      meshes(json);
      json.key("accessors").open_array();
      for (const Part& part : parts_) { accessors(json, part); }
      json.close();
      json.key("bufferViews").open_array();
      views(json);
      json.close();
      json.key("buffers").open_array().object("byteLength", binary_.size()).close();
    }
    json.close();
    return json.text();
  }

  const ExportMesh& mesh_;
  const std::vector<glm::vec2>& coordinates_;
  radiosity::Tone tone_;
  glm::dvec3 centre_{0.0};
  double size_ = 1.0;
  std::vector<Part> parts_;
  std::size_t indices_ = 0;
  std::string binary_;
};

std::string write_glb(const ExportMesh& mesh, const radiosity::Tone& tone) {
  std::vector<glm::vec2> coordinates;
  if (mesh.coordinates.empty()) { return Writer(mesh, coordinates, tone).file(); }
  const ExportMesh split = split_at_seams(mesh, coordinates);
  return Writer(split, coordinates, tone).file();
}

}  // namespace

constinit const ExportFormat glb{".glb", write_glb};

}  // namespace apps::exported
