// SPDX-License-Identifier: MIT
// The formats of polygon meshes (mesh_file.hpp) as scenes: PLY and OFF are geometry alone, OBJ has groups, and materials in files of its
// own (obj_materials.hpp).
#include <brep/builder_input.hpp>

#include "apps/file_kind.hpp"
#include "apps/intake/model.hpp"
#include "apps/intake/obj_materials.hpp"
#include "apps/mesh_file.hpp"

namespace apps::intake {
namespace {

ModelResult read(std::string_view bytes, const MeshFormat& format, const SideFile& side_file) {
  MeshResult result = read_mesh(bytes, format);
  if (!result.mesh) { return {std::move(result), std::nullopt}; }
  Mesh& mesh = *result.mesh;
  Model model;
  Notes notes;
  const brep::Builder& builder = mesh.builder;
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) { model.positions.push_back(builder.position(v)); }
  for (const std::string& name : mesh.materials) { model.materials.push_back({name, {}, radiosity::Color(0.0), false}); }
  if (model.materials.empty()) { model.materials.push_back({"default", {}, radiosity::Color(0.0), false}); }
  model.groups = mesh.groups;
  if (model.groups.empty()) { model.groups.emplace_back("mesh"); }
  const auto of = [](const std::vector<std::uint32_t>& list, std::uint32_t f) { return f < list.size() ? list[f] : 0; };
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    model.polygon(builder.corners(f), of(mesh.face_material, f), of(mesh.face_group, f), of(mesh.face_line, f));
  }
  for (const std::string& library : mesh.libraries) { read_obj_materials(library, side_file, model.materials, notes); }
  model.notes = std::move(mesh.notes);
  for (std::string& note : notes.take()) { model.notes.push_back(std::move(note)); }
  return {std::move(result), std::move(model)};
}

template <const MeshFormat* format>
ModelResult read_format(std::string_view bytes, const SideFile& side_file) {
  return read(bytes, *format, side_file);
}

template <const MeshFormat* format>
bool begins_format(std::string_view bytes) {
  return guess_kind(bytes).format == format;
}

}  // namespace
}  // namespace apps::intake

namespace apps {
namespace mesh_file {
extern const MeshFormat obj_format, ply_format, off_format;
}
namespace intake {

extern const ModelFormat obj, ply, off;
constinit const ModelFormat obj{".obj", "OBJ", UpAxis::y, begins_format<&mesh_file::obj_format>, read_format<&mesh_file::obj_format>};
constinit const ModelFormat ply{".ply", "PLY", UpAxis::z, begins_format<&mesh_file::ply_format>, read_format<&mesh_file::ply_format>};
constinit const ModelFormat off{".off", "OFF", UpAxis::z, begins_format<&mesh_file::off_format>, read_format<&mesh_file::off_format>};

}  // namespace intake
}  // namespace apps
