// SPDX-License-Identifier: MIT
// libFuzzer target: the input is read as a scene, as a mesh and as a model of every format, as a Draco stream, and as the light of a
// solution; with --format=obj (scene, light, drc, or the ending of another format) as that alone. Nothing crashes; what is refused says why
// and where; a mesh that is read and written reads back the same; what the intake makes of a model is a sound scene; light that is read is
// written as it was.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/bytes.hpp"
#include "apps/intake/draco.hpp"
#include "apps/intake/model.hpp"
#include "apps/intake/to_scene.hpp"
#include "apps/light_file.hpp"
#include "apps/mesh_file.hpp"
#include "apps/scene_file.hpp"

#include <brep/builder_input.hpp>
#include <radiosity/scene/scene.hpp>

namespace {

void require(bool holds, const char* law) {
  if (holds) { return; }
  std::fprintf(stderr, "broken: %s\n", law);
  std::abort();
}

void read_as_mesh(std::string_view text, const apps::MeshFormat& format) {
  const apps::MeshResult result = apps::read_mesh(text, format);
  require(result.mesh.has_value() == result.errors.empty(), "either a mesh or errors");
  if (!result.mesh) { return; }
  const apps::MeshResult again = apps::read_mesh(apps::write_mesh(result.mesh->builder, format), format);
  require(again.mesh.has_value(), "what was written can be read");
  const brep::Builder &read = result.mesh->builder, &reread = again.mesh->builder;
  require(read.vertex_count() == reread.vertex_count() && read.face_count() == reread.face_count(), "nothing is lost");
  for (std::uint32_t v = 0; v < read.vertex_count(); ++v) {
    require(read.position(v) == reread.position(v), "positions read back exactly");
  }
  for (std::uint32_t f = 0; f < read.face_count(); ++f) {
    const auto corners = read.corners(f), recorners = reread.corners(f);
    require(std::equal(corners.begin(), corners.end(), recorners.begin(), recorners.end()), "faces read back");
  }
}

void read_as_model(std::string_view text, const apps::ModelFormat& format) {
  // A file beside it is what stands behind a form feed, or the file itself.
  const std::size_t feed = text.find('\f');
  const std::string beside(feed == text.npos ? text : text.substr(feed + 1));
  text = text.substr(0, feed);
  apps::ModelResult result = format.read(text, [&](const std::string&, std::string&) { return std::optional(beside); });
  require(result.model.has_value() == result.errors.empty(), "either a model or errors");
  if (!result.model || result.model->polygons() > 500 || result.model->objects.size() > 100) { return; }
  std::vector<std::string> faults;
  const auto file = apps::to_scene(std::move(*result.model), format.up, {}, faults);
  require(file.has_value() == faults.empty(), "either a scene or faults");
  require(!file || radiosity::faults(file->scene).empty(), "what was taken in is sound");
}

void read_as_draco(std::string_view bytes) {
  std::string fault;
  const auto mesh = apps::intake::draco::read_mesh(bytes, fault);
  require(mesh.has_value() == fault.empty(), "either a mesh or a fault");
  if (!mesh) { return; }
  require(std::all_of(mesh->corners.begin(), mesh->corners.end(), [&](std::uint32_t point) { return point < mesh->points; }),
          "triangles name points that are there");
  for (const auto& attribute : mesh->attributes) {
    require(attribute.values.empty() || attribute.values.size() == mesh->points * attribute.components, "a value for each point");
  }
}

// The input is what stands between the key and the checksum: chance would find neither.
void read_as_light(std::string_view body) {
  static const radiosity::Scene scene =
      apps::parse_scene("material lamp reflectance 0 emission 1\nsphere ball center 1 1 1 radius 1 material lamp\n").file->scene;
  static const std::string head = [] {
    const std::string file = apps::to_light_file({}, *radiosity::make_frame(scene), scene, {});
    return file.substr(0, file.size() - 3 * 8 - 16);  // without counts and checksum
  }();
  const auto signed_file = [](std::string bytes) {
    apps::Checksum checksum;
    checksum.add(bytes);
    return bytes + checksum.text();
  };
  require(!apps::read_light_file(body, scene).light, "light without its checksum is refused");
  if (const auto source = apps::read_scene_source(body)) {
    const auto again = apps::read_scene_source(apps::to_bytes(*source));
    require(again && apps::to_bytes(*again) == apps::to_bytes(*source), "a source is written as it was read");
  }
  const std::string bytes = signed_file(head + std::string(body));
  const apps::LightResult result = apps::read_light_file(bytes, scene);
  require(result.light.has_value() == result.reason.empty(), "either light or a reason");
  if (result.light) {
    require(apps::to_light_file(result.light->mesh, result.light->frame, scene, {}) == bytes, "light is written as it was read");
  }
}

std::string_view asked_format;  // empty: all

bool asked(std::string_view ending) { return asked_format.empty() || ending == asked_format || ending.substr(1) == asked_format; }

}  // namespace

extern "C" int LLVMFuzzerInitialize(const int* count, char*** arguments) {
  for (int i = 1; i < *count; ++i) {
    const std::string_view argument = (*arguments)[i];
    if (argument.starts_with("--format=")) { asked_format = argument.substr(9); }
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (asked("scene")) {
    const apps::SceneResult scene = apps::parse_scene(text);
    require(scene.file.has_value() == scene.errors.empty(), "either a scene or errors");
  }
  if (asked("light")) { read_as_light(text); }
  if (asked("drc")) { read_as_draco(text); }
  for (const apps::MeshFormat* const format : apps::mesh_formats()) {
    if (asked(format->ending)) { read_as_mesh(text, *format); }
  }
  for (const apps::ModelFormat* const format : apps::model_formats()) {
    if (asked(format->ending)) { read_as_model(text, *format); }
  }
  return 0;
}
