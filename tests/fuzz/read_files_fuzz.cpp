// SPDX-License-Identifier: MIT
// libFuzzer target: the input is read as a scene and as a mesh of every format. Nothing crashes; what is refused says why and where; a
// mesh that is read and written reads back the same.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "apps/mesh_file.hpp"
#include "apps/scene_file.hpp"

#include <brep/builder_input.hpp>

namespace {

void require(bool holds, const char* law) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", law);
  std::abort();
}

void read_as_mesh(std::string_view text, const apps::MeshFormat& format) {
  const apps::MeshResult result = apps::read_mesh(text, format);
  require(result.mesh.has_value() == result.errors.empty(), "either a mesh or errors");
  if (!result.mesh) return;
  const apps::MeshResult again = apps::read_mesh(apps::write_mesh(result.mesh->builder, format), format);
  require(again.mesh.has_value(), "what was written can be read");
  const brep::Builder &read = result.mesh->builder, &reread = again.mesh->builder;
  require(read.vertex_count() == reread.vertex_count() && read.face_count() == reread.face_count(), "nothing is lost");
  for (std::uint32_t v = 0; v < read.vertex_count(); ++v) require(read.position(v) == reread.position(v), "positions read back exactly");
  for (std::uint32_t f = 0; f < read.face_count(); ++f) {
    const auto corners = read.corners(f), recorners = reread.corners(f);
    require(std::equal(corners.begin(), corners.end(), recorners.begin(), recorners.end()), "faces read back");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const apps::SceneResult scene = apps::parse_scene(text);
  require(scene.file.has_value() == scene.errors.empty(), "either a scene or errors");
  for (const apps::MeshFormat* const format : apps::mesh_formats()) read_as_mesh(text, *format);
  return 0;
}
