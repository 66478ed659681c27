// SPDX-License-Identifier: MIT
#include "apps/light_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/finite.hpp>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>

#include "apps/archive.hpp"
#include "apps/bytes.hpp"

namespace apps {

// --- what the scene was read from

namespace {

struct SourceFields {
  template <class Archive, class T>
  void operator()(Archive& a, T& x) const {
    using Type = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Type, SceneSource>) {
      a(x.path, x.text, x.beside, x.options);
    } else if constexpr (std::is_same_v<Type, FileBeside>) {
      a(x.name, x.bytes);
    } else if constexpr (std::is_same_v<Type, Lamp>) {
      a(x.material, x.exitance);
    } else if constexpr (std::is_same_v<Type, radiosity::Camera>) {
      a(x.eye, x.forward, x.up);
    } else {
      static_assert(std::is_same_v<Type, ModelOptions>);
      a(x.reflectance, x.metres, x.two_sided, x.merge, x.opaque, x.up, x.lamps, x.camera);
    }
  }
};

bool usable(const ModelOptions& options) {
  const auto& camera = options.camera;
  return options.reflectance >= 0.0 && options.reflectance <= most_reflectance && options.metres > 0.0 && std::isfinite(options.metres) &&
         (!options.up || *options.up <= UpAxis::z) &&
         std::all_of(options.lamps.begin(), options.lamps.end(),
                     [](const Lamp& lamp) { return lamp.exitance >= 0.0 && std::isfinite(lamp.exitance); }) &&
         (!camera || (brep::is_finite(camera->eye) && brep::is_finite(camera->forward) && brep::is_finite(camera->up) &&
                      glm::length(glm::cross(camera->forward, camera->up)) > 0.0));
}

}  // namespace

std::string to_bytes(const SceneSource& source) {
  ArchiveWriter<SourceFields> out;
  out(source);
  return std::move(out.bytes);
}

std::optional<SceneSource> read_scene_source(std::string_view bytes) {
  ArchiveReader<SourceFields> in(bytes);
  SceneSource source;
  in(source);
  return in.sound() && in.left() == 0 && usable(source.options) ? std::optional(std::move(source)) : std::nullopt;
}

SideFile files_of(const SceneSource& source) {
  return [&source](const std::string& name, std::string& fault) -> std::optional<std::string> {
    const auto found = std::find_if(source.beside.begin(), source.beside.end(), [&](const FileBeside& file) { return file.name == name; });
    if (found != source.beside.end()) { return found->bytes; }
    fault = "is not in the .light file";
    return std::nullopt;
  };
}

// --- the light

namespace {

constexpr std::string_view light_opening = "halflight light 3\n";
constexpr std::size_t checksum_digits = 16;  // of a checksum

// A checksum of everything that the light depends on: colours, and shapes by the corners of coarse approximations.
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

struct MeshFields {
  template <class Archive, class T>
  void operator()(Archive& a, T& x) const {
    if constexpr (std::is_same_v<std::remove_const_t<T>, radiosity::MeshCorner>) {
      a(x.vertex, x.radiosity, x.normal);
    } else {
      static_assert(std::is_same_v<std::remove_const_t<T>, radiosity::MeshFace>);
      a(x.first_corner, x.corner_count, x.surface, x.radiosity);
    }
  }
};

constexpr std::size_t bytes_of_head = 3 * 8, bytes_of_position = 3 * 8, bytes_of_corner = 4 + 3 * 8 + 3 * 4, bytes_of_face = 3 * 4 + 3 * 8;

// Are all indices within range and all numbers finite?
bool consistent(const radiosity::Mesh& mesh, std::size_t surfaces) {
  for (const glm::dvec3& p : mesh.positions) {
    if (!brep::is_finite(p)) { return false; }
  }
  for (const radiosity::MeshCorner& corner : mesh.corners) {
    if (corner.vertex >= mesh.positions.size() || !brep::is_finite(corner.radiosity) || !brep::is_finite(glm::dvec3(corner.normal))) {
      return false;
    }
  }
  for (const radiosity::MeshFace& face : mesh.faces) {
    if (face.corner_count < 3 || face.corner_count > 4 || std::uint64_t{face.first_corner} + face.corner_count > mesh.corners.size()) {
      return false;
    }
    if (face.surface >= surfaces || !brep::is_finite(face.radiosity)) { return false; }
  }
  return true;
}

constexpr const char* damaged = "the file is damaged";

struct LightParts {
  std::string_view key, source, mesh;
};

// The parts of a file whose checksum is correct.
std::optional<LightParts> parts_of(std::string_view bytes, std::string& reason) {
  reason = "not a .light file of this version";
  if (!bytes.starts_with(light_opening)) { return std::nullopt; }
  reason = damaged;
  const std::size_t before = light_opening.size() + checksum_digits + 1;
  constexpr std::size_t bytes_of_length = 8;
  if (bytes.size() < before + bytes_of_length + bytes_of_head + checksum_digits) { return std::nullopt; }
  if (checksum_of(bytes.substr(0, bytes.size() - checksum_digits)) != bytes.substr(bytes.size() - checksum_digits)) { return std::nullopt; }
  const std::string_view rest = bytes.substr(before + bytes_of_length, bytes.size() - before - bytes_of_length - checksum_digits);
  const std::uint64_t source = bits_at(bytes, before, bytes_of_length);
  if (source > rest.size() - bytes_of_head) { return std::nullopt; }
  reason.clear();
  return LightParts{bytes.substr(light_opening.size(), checksum_digits), rest.substr(0, source), rest.substr(source)};
}

}  // namespace

std::string to_light_file(const radiosity::Mesh& mesh, const radiosity::Frame& frame, const radiosity::Scene& scene,
                          const SceneSource& source) {
  ArchiveWriter<MeshFields> out;
  out.bytes = std::string(light_opening) + key_of(scene, frame) + "\n";
  out(to_bytes(source), std::uint64_t{mesh.positions.size()}, std::uint64_t{mesh.corners.size()}, std::uint64_t{mesh.faces.size()});
  for (const glm::dvec3& p : mesh.positions) { out(p); }
  for (const radiosity::MeshCorner& corner : mesh.corners) { out(corner); }
  for (const radiosity::MeshFace& face : mesh.faces) { out(face); }
  return out.bytes + checksum_of(out.bytes);
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
  ArchiveReader<MeshFields> in{parts->mesh};
  Light light;
  light.frame = *frame;
  std::uint64_t positions = 0, corners = 0, faces = 0;
  in(positions, corners, faces);
  const std::uint64_t most = in.left();  // no count can be larger; ensures that the sum below does not overflow
  if (positions > most || corners > most || faces > most ||
      positions * bytes_of_position + corners * bytes_of_corner + faces * bytes_of_face != in.left()) {
    return {std::nullopt, damaged};
  }
  light.mesh.positions.assign(positions, glm::dvec3{0.0});
  light.mesh.corners.resize(corners);
  light.mesh.faces.resize(faces);
  for (glm::dvec3& p : light.mesh.positions) { in(p); }
  for (radiosity::MeshCorner& corner : light.mesh.corners) { in(corner); }
  for (radiosity::MeshFace& face : light.mesh.faces) {
    in(face);
    face.node = radiosity::no_node;
  }
  if (!consistent(light.mesh, radiosity::surfaces(scene).size())) { return {std::nullopt, damaged}; }
  return {std::move(light), {}};
}

}  // namespace apps
