// SPDX-License-Identifier: MIT
#include "apps/export/export_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

#include "apps/bytes.hpp"

namespace apps {
namespace {

// Numbers the different combinations of mesh vertex, colour and normal, in the order of first use. Normals are compared to 1 / 1000.
class Vertices {
 public:
  std::uint32_t index(std::uint32_t vertex, const radiosity::Rgb8& rgb, const glm::vec3& normal) {
    std::array<std::uint32_t, 5> key{vertex, std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2], 0, 0, 0};
    for (int c = 0; c < 3; ++c) {
      key[2 + static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(std::lround(1000.0f * normal[c]) + 2000);
    }
    return index_.emplace(key, static_cast<std::uint32_t>(index_.size())).first->second;
  }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(index_.size()); }

 private:
  std::map<std::array<std::uint32_t, 5>, std::uint32_t> index_;
};

bool is_float(const glm::dvec3& p) { return glm::dvec3(glm::vec3(p)) == p; }

}  // namespace

std::string to_ply(const ExportMesh& mesh, const radiosity::Tone& tone) {
  const bool single = std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const ExportVertex& v) { return is_float(v.position); });
  bool wide = false;
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) { wide = wide || mesh.face(f).size() > 255; }
  std::vector<std::string_view> of_vertex = single ? std::vector<std::string_view>{"float x", "float y", "float z"}
                                                   : std::vector<std::string_view>{"double x", "double y", "double z"};
  for (const std::string_view property : {"float nx", "float ny", "float nz", "uchar red", "uchar green", "uchar blue", "float radiosity_r",
                                          "float radiosity_g", "float radiosity_b"}) {
    of_vertex.push_back(property);
  }
  std::string bytes = ply_header({"halflight: radiosity in W/m2, vertex colours sRGB"},
                                 {{"vertex", mesh.vertices.size(), of_vertex},
                                  {"face", mesh.faces(), {wide ? "list int int vertex_indices" : "list uchar int vertex_indices"}}});
  for (const ExportVertex& vertex : mesh.vertices) {
    for (int c = 0; c < 3; ++c) { single ? put(bytes, static_cast<float>(vertex.position[c])) : put(bytes, vertex.position[c]); }
    for (int c = 0; c < 3; ++c) { put(bytes, static_cast<float>(vertex.normal[c])); }
    for (const std::uint8_t byte : radiosity::to_rgb8(tone(vertex.radiosity))) { put(bytes, byte); }
    for (int c = 0; c < 3; ++c) { put(bytes, static_cast<float>(vertex.radiosity[c])); }
  }
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
    const auto size = static_cast<std::uint32_t>(mesh.face(f).size());
    wide ? put(bytes, size) : put(bytes, static_cast<std::uint8_t>(size));
    for (const std::uint32_t v : mesh.face(f)) { put(bytes, v); }
  }
  return bytes;
}

std::string to_ply(const radiosity::Mesh& mesh, const std::vector<radiosity::InputSurface>& surfaces, const radiosity::Tone& tone) {
  Vertices vertices;
  std::string vertex_bytes;
  std::string face_bytes;
  for (const radiosity::MeshFace& face : mesh.faces) {
    face_bytes += static_cast<char>(face.corner_count);
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      const radiosity::MeshCorner& corner = mesh.corners[face.first_corner + k];
      const radiosity::Rgb8 rgb = radiosity::to_rgb8(tone(corner.radiosity));
      const std::uint32_t before = vertices.size();
      put(face_bytes, vertices.index(corner.vertex, rgb, corner.normal));
      if (vertices.size() == before) { continue; }
      const glm::dvec3& position = mesh.positions[corner.vertex];
      for (int c = 0; c < 3; ++c) { put(vertex_bytes, static_cast<float>(position[c])); }
      for (int c = 0; c < 3; ++c) { put(vertex_bytes, corner.normal[c]); }
      for (const std::uint8_t byte : rgb) { put(vertex_bytes, byte); }
    }
    for (int c = 0; c < 3; ++c) { put(face_bytes, static_cast<float>(face.radiosity[c])); }
    put(face_bytes, face.surface);
  }
  std::vector<std::string> comments = {"halflight: radiosity in W/m2, vertex colours sRGB"};
  for (std::size_t i = 0; i < surfaces.size(); ++i) { comments.push_back("surface " + std::to_string(i) + " " + surfaces[i].name); }
  return ply_header(comments,
                    {{"vertex",
                      vertices.size(),
                      {"float x", "float y", "float z", "float nx", "float ny", "float nz", "uchar red", "uchar green", "uchar blue"}},
                     {"face",
                      mesh.faces.size(),
                      {"list uchar int vertex_indices", "float radiosity_r", "float radiosity_g", "float radiosity_b", "int surface"}}}) +
         vertex_bytes + face_bytes;
}

}  // namespace apps
