// SPDX-License-Identifier: MIT
#include "apps/ply.hpp"

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/color.hpp"
#include "apps/mesh_file/ply_bytes.hpp"

namespace apps {
namespace {

// Gives each pair of mesh vertex and colour its own number, in the order of first use.
class Vertices {
 public:
  std::uint32_t index(std::uint32_t vertex, const Rgb8& rgb) {
    const std::uint64_t color = (std::uint64_t{rgb[0]} << 16) | (std::uint64_t{rgb[1]} << 8) | rgb[2];
    const auto [entry, is_new] = index_.emplace((std::uint64_t{vertex} << 24) | color, size_);
    if (is_new) { ++size_; }
    return entry->second;
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  std::uint32_t size_ = 0;
};

}  // namespace

std::string to_ply(const radiosity::Mesh& mesh, const std::vector<radiosity::InputSurface>& surfaces, const Tone& tone) {
  Vertices vertices;
  std::string vertex_bytes;
  std::string face_bytes;
  for (const radiosity::MeshFace& face : mesh.faces) {
    face_bytes += static_cast<char>(face.corner_count);
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      const radiosity::MeshCorner& corner = mesh.corners[face.first_corner + k];
      const Rgb8 rgb = to_rgb8(tone(corner.radiosity));
      const std::uint32_t before = vertices.size();
      put(face_bytes, vertices.index(corner.vertex, rgb));
      if (vertices.size() == before) { continue; }
      const glm::dvec3& position = mesh.positions[corner.vertex];
      for (int c = 0; c < 3; ++c) { put(vertex_bytes, static_cast<float>(position[c])); }
      for (const std::uint8_t byte : rgb) { put(vertex_bytes, byte); }
    }
    for (int c = 0; c < 3; ++c) { put(face_bytes, static_cast<float>(face.radiosity[c])); }
    put(face_bytes, face.surface);
  }
  std::vector<std::string> comments = {"halflight: radiosity in W/m2, vertex colours sRGB"};
  for (std::size_t i = 0; i < surfaces.size(); ++i) { comments.push_back("surface " + std::to_string(i) + " " + surfaces[i].name); }
  return ply_header(comments,
                    {{"vertex", vertices.size(), {"float x", "float y", "float z", "uchar red", "uchar green", "uchar blue"}},
                     {"face",
                      mesh.faces.size(),
                      {"list uchar int vertex_indices", "float radiosity_r", "float radiosity_g", "float radiosity_b", "int surface"}}}) +
         vertex_bytes + face_bytes;
}

}  // namespace apps
