// SPDX-License-Identifier: MIT
#pragma once

// Polygon meshes from files: OBJ (Wavefront), PLY (Turk 1994: ascii, binary little and big endian), OFF (Geomview: OFF, COFF,
// NOFF, STOFF and their combinations). Positions and faces are read into a builder, with their colours and texture coordinates; everything
// else is passed over.
//
// Reading gives the mesh or a list of errors; each says where it lies and what was expected. Whether the faces make a surface is
// not asked here: that is the builder's question. No input makes it throw, crash, run without end, or hold more memory than
// a small multiple of the file: a count in a header is believed as far as the file reaches.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>

#include "apps/input_errors.hpp"

namespace apps {

struct Mesh {
  brep::Builder builder;
  std::vector<std::uint32_t> vertex_line, face_line;  // where each stands in the file; empty for binary files
  std::vector<std::string> notes;                     // what was passed over and may matter

  // What formats with materials and groups say of each face: empty where a file has none. Libraries are files with materials.
  std::vector<std::uint32_t> face_material, face_group;
  std::vector<std::string> materials, groups, libraries;

  // In sRGB from 0 to 1, NaN where a vertex or a face has none; as far as there are any. A face's own colour counts more.
  std::vector<glm::vec3> vertex_color, face_color;
  // Texture coordinates of all corners of all faces in their order, as far as there are any; (0, 0) is the beginning of the last row of a
  // picture.
  std::vector<glm::vec2> corner_place;
};

struct MeshResult : ErrorReport {
  std::optional<Mesh> mesh;  // nothing when there are errors
};

// Faces that belong together, up to where the next group begins.
struct MeshGroup {
  std::uint32_t first_face = 0;
  std::string name;
};

namespace mesh_file {
class Output;  // what a reader fills (mesh_file/reading.hpp)
}

// A format: one file in mesh_file/ defines it; it is named below, and in the list of mesh_file/mesh_file.cpp.
struct MeshFormat {
  std::string_view ending;   // of the name, in small letters: ".obj"
  std::string_view file;     // "an OBJ file"
  std::string_view content;  // "a polygon mesh (Wavefront OBJ)"
  bool text;                 // a zero byte shows that it is another file
  // Does a file of this format have a line that begins with these three words (empty where there are fewer), as its first one?
  bool (*begins)(std::span<const std::string_view, 3> words, bool first);
  void (*read)(std::string_view bytes, mesh_file::Output& out);
  std::string (*write)(const brep::Builder& builder, std::span<const MeshGroup> groups);
};

namespace mesh_file {
extern const MeshFormat obj_format, ply_format, off_format;  // a file of this folder each
}
[[nodiscard]] std::span<const MeshFormat* const> mesh_formats();

// ".obj, .ply or .off"
[[nodiscard]] std::string mesh_endings();

// By the ending of the name, in any case; null when no format has it.
[[nodiscard]] const MeshFormat* mesh_format(std::string_view path);
[[nodiscard]] bool has_ending(std::string_view path, std::string_view ending);

[[nodiscard]] MeshResult read_mesh(std::string_view bytes, const MeshFormat& format);

// The file's bytes; PLY is binary little endian. Positions are written so that they read back exactly. Every corner must exist.
// Groups, by rising first face, become objects in OBJ ("o name"); the other formats have no such thing.
[[nodiscard]] std::string write_mesh(const brep::Builder& builder, const MeshFormat& format, std::span<const MeshGroup> groups = {});

}  // namespace apps
