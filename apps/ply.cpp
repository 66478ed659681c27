// SPDX-License-Identifier: MIT
#include "apps/ply.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "apps/color.hpp"

namespace apps {
namespace {

void put(std::string& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) { out += static_cast<char>(static_cast<unsigned char>(value >> shift)); }
}

void put(std::string& out, double value) {
  static_assert(std::numeric_limits<float>::is_iec559);
  put(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

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

std::string header(std::size_t vertices, std::size_t faces, const std::vector<radiosity::InputSurface>& surfaces) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment halflight: radiosity in W/m2, vertex colours sRGB\n";
  for (std::size_t i = 0; i < surfaces.size(); ++i) { text += "comment surface " + std::to_string(i) + " " + surfaces[i].name + "\n"; }
  text += "element vertex " + std::to_string(vertices) + "\n";
  text += "property float x\nproperty float y\nproperty float z\n";
  text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "element face " + std::to_string(faces) + "\n";
  text += "property list uchar int vertex_indices\n";
  text += "property float radiosity_r\nproperty float radiosity_g\nproperty float radiosity_b\nproperty int surface\n";
  return text + "end_header\n";
}

}  // namespace

std::string to_ply(const radiosity::Mesh& mesh, const std::vector<radiosity::InputSurface>& surfaces, double exposure) {
  Vertices vertices;
  std::string vertex_bytes;
  std::string face_bytes;
  for (const radiosity::MeshFace& face : mesh.faces) {
    face_bytes += static_cast<char>(face.corner_count);
    for (std::uint32_t k = 0; k < face.corner_count; ++k) {
      const radiosity::MeshCorner& corner = mesh.corners[face.first_corner + k];
      const Rgb8 rgb = to_rgb8(shown(corner.radiosity, exposure));
      const std::uint32_t before = vertices.size();
      put(face_bytes, vertices.index(corner.vertex, rgb));
      if (vertices.size() == before) { continue; }
      const glm::dvec3& position = mesh.positions[corner.vertex];
      for (int c = 0; c < 3; ++c) { put(vertex_bytes, position[c]); }
      for (const std::uint8_t byte : rgb) { vertex_bytes += static_cast<char>(byte); }
    }
    for (int c = 0; c < 3; ++c) { put(face_bytes, face.radiosity[c]); }
    put(face_bytes, face.surface);
  }
  return header(vertices.size(), mesh.faces.size(), surfaces) + vertex_bytes + face_bytes;
}

}  // namespace apps
