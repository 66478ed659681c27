// SPDX-License-Identifier: MIT
#include "apps/light_file.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>

#include "apps/bytes.hpp"
#include "apps/checksum.hpp"

namespace apps {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in memory");

constexpr std::string_view light_opening = "halflight light 2\n";
constexpr std::size_t digits = 16;  // of a checksum

std::string checksum_of_bytes(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.text();
}

// Changes with everything that the light depends on: colours, and shapes by the corners of coarse approximations.
std::string key_of(const radiosity::Scene& scene, const radiosity::Frame& frame) {
  Checksum sum;
  const auto add = [&](const glm::dvec3& v) {
    for (int c = 0; c < 3; ++c) { sum.add(v[c]); }
  };
  for (const radiosity::InputSurface& surface : radiosity::surfaces(scene)) {
    add(scene.materials[surface.material].reflectance);
    add(scene.materials[surface.material].emission);
  }
  add(frame.centre);
  sum.add(frame.scale);
  const raycast::Scene objects = radiosity::compile(scene, frame);
  for (std::uint32_t o = 0; o < objects.size(); ++o) {
    const raycast::PlacedObject& object = objects.object(o);
    sum.add(std::uint64_t{object.sheet_count()});
    sum.add(std::uint64_t{object.inside()});
    brep::Builder builder;
    object.approximate(0.1 * object.bounds().diameter(), builder);
    for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) { add(builder.position(v)); }
  }
  return sum.text();
}

class LightReader {
 public:
  explicit LightReader(std::string_view bytes) : rest_{bytes} {}
  [[nodiscard]] std::size_t left() const { return rest_.size(); }
  [[nodiscard]] std::string_view text(std::size_t count) {
    const std::string_view result = rest_.substr(0, count);
    rest_.remove_prefix(result.size());
    return result;
  }
  // The caller has asked how much is left.
  template <class Number>
  void get(Number& number) {
    std::memcpy(&number, rest_.data(), sizeof(Number));
    rest_.remove_prefix(sizeof(Number));
  }
  template <class Vector>
  void get_vector(Vector& v) {
    for (int c = 0; c < 3; ++c) { get(v[c]); }
  }

 private:
  std::string_view rest_;
};

constexpr std::size_t bytes_of_head = 3 * 8, bytes_of_position = 3 * 8, bytes_of_corner = 4 + 3 * 8 + 3 * 4, bytes_of_face = 3 * 4 + 3 * 8;

bool all_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Do all numbers name what there is?
bool consistent(const radiosity::Mesh& mesh, std::size_t surfaces) {
  for (const glm::dvec3& p : mesh.positions) {
    if (!all_finite(p)) { return false; }
  }
  for (const radiosity::MeshCorner& corner : mesh.corners) {
    if (corner.vertex >= mesh.positions.size() || !all_finite(corner.radiosity) || !all_finite(glm::dvec3(corner.normal))) { return false; }
  }
  for (const radiosity::MeshFace& face : mesh.faces) {
    if (face.corner_count < 3 || face.corner_count > 4 || std::uint64_t{face.first_corner} + face.corner_count > mesh.corners.size()) {
      return false;
    }
    if (face.surface >= surfaces || !all_finite(face.radiosity)) { return false; }
  }
  return true;
}

constexpr const char* damaged = "the file is damaged";

struct LightParts {
  std::string_view key, source, mesh;
};

// The parts of a file whose checksum is right.
std::optional<LightParts> parts_of(std::string_view bytes, std::string& reason) {
  reason = "not a .light file of this version";
  if (!bytes.starts_with(light_opening)) { return std::nullopt; }
  reason = damaged;
  const std::size_t before = light_opening.size() + digits + 1;
  constexpr std::size_t bytes_of_length = 8;
  if (bytes.size() < before + bytes_of_length + bytes_of_head + digits) { return std::nullopt; }
  if (checksum_of_bytes(bytes.substr(0, bytes.size() - digits)) != bytes.substr(bytes.size() - digits)) { return std::nullopt; }
  const std::string_view rest = bytes.substr(before + bytes_of_length, bytes.size() - before - bytes_of_length - digits);
  const std::uint64_t source = bits_at(bytes, before, bytes_of_length);
  if (source > rest.size() - bytes_of_head) { return std::nullopt; }
  reason.clear();
  return LightParts{bytes.substr(light_opening.size(), digits), rest.substr(0, source), rest.substr(source)};
}

}  // namespace

std::string to_light_file(const radiosity::Mesh& mesh, const radiosity::Frame& frame, const radiosity::Scene& scene,
                          const SceneSource& source) {
  std::string bytes = std::string(light_opening) + key_of(scene, frame) + "\n";
  const std::string own = to_bytes(source);
  put(bytes, std::uint64_t{own.size()});
  bytes += own;
  for (const std::size_t count : {mesh.positions.size(), mesh.corners.size(), mesh.faces.size()}) { put(bytes, std::uint64_t{count}); }
  for (const glm::dvec3& p : mesh.positions) { put(bytes, p); }
  for (const radiosity::MeshCorner& corner : mesh.corners) {
    put(bytes, corner.vertex);
    put(bytes, corner.radiosity);
    put(bytes, corner.normal);
  }
  for (const radiosity::MeshFace& face : mesh.faces) {
    put(bytes, face.first_corner);
    put(bytes, face.corner_count);
    put(bytes, face.surface);
    put(bytes, face.radiosity);
  }
  return bytes + checksum_of_bytes(bytes);
}

std::optional<SceneSource> source_in_light_file(std::string_view bytes, std::string& reason) {
  const auto parts = parts_of(bytes, reason);
  if (!parts) { return std::nullopt; }
  auto source = read_scene_source(parts->source);
  if (!source) { reason = damaged; }
  return source;
}

LightResult read_light_file(std::string_view bytes, const radiosity::Scene& scene) {
  LightResult result;
  const auto parts = parts_of(bytes, result.reason);
  if (!parts) { return result; }
  const auto frame = radiosity::make_frame(scene);
  if (!frame || key_of(scene, *frame) != parts->key) { return {std::nullopt, "it holds the light of another scene"}; }
  LightReader in{parts->mesh};
  Light light;
  light.frame = *frame;
  std::uint64_t positions = 0, corners = 0, faces = 0;
  in.get(positions);
  in.get(corners);
  in.get(faces);
  const std::uint64_t most = in.left();  // no count is larger, so that the sum below does not overflow
  if (positions > most || corners > most || faces > most ||
      positions * bytes_of_position + corners * bytes_of_corner + faces * bytes_of_face != in.left()) {
    return {std::nullopt, damaged};
  }
  light.mesh.positions.assign(positions, glm::dvec3{0.0});
  for (glm::dvec3& p : light.mesh.positions) { in.get_vector(p); }
  light.mesh.corners.resize(corners);
  for (radiosity::MeshCorner& corner : light.mesh.corners) {
    in.get(corner.vertex);
    in.get_vector(corner.radiosity);
    in.get_vector(corner.normal);
  }
  light.mesh.faces.resize(faces);
  for (radiosity::MeshFace& face : light.mesh.faces) {
    in.get(face.first_corner);
    in.get(face.corner_count);
    in.get(face.surface);
    in.get_vector(face.radiosity);
    face.node = radiosity::no_node;
  }
  if (!consistent(light.mesh, radiosity::surfaces(scene).size())) { return {std::nullopt, damaged}; }
  return {std::move(light), {}};
}

}  // namespace apps
