// SPDX-License-Identifier: MIT
#pragma once

// Polygon meshes from files: OBJ (Wavefront), PLY (Turk 1994: ascii, binary little and big endian), OFF (Geomview: OFF, COFF, NOFF, STOFF
// and their combinations). Positions and faces go into a builder, with their colours and texture coordinates; everything else is ignored.
//
// Reading gives the mesh or a list of errors, each with its place and what was expected. Whether the faces form a surface is not checked
// here but by the builder. No input makes reading throw, crash, run without end, or use more memory than a small multiple of the file:
// counts in a header are limited by the size of the file.

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
  std::vector<std::uint32_t> vertex_line, face_line;  // by index: the line in the file; empty for binary files
  std::vector<std::string> notes;                     // about ignored contents that may matter

  // By face, in formats with materials and groups; empty if a file has none. Libraries are names of material files.
  std::vector<std::uint32_t> face_material, face_group;
  std::vector<std::string> materials, groups, libraries;

  // sRGB from 0 to 1, NaN for a vertex or face without a colour; may be shorter than the number of elements. A face's own
  // colour takes precedence.
  std::vector<glm::vec3> vertex_color, face_color;
  // Texture coordinates of all corners of all faces, in order; may be shorter than their number. (0, 0) is the start of a picture's last
  // row.
  std::vector<glm::vec2> corner_place;
};

struct MeshResult : ErrorReport {
  std::optional<Mesh> mesh;  // nothing if there are errors
};

// A group of faces, which ends where the next group begins.
struct MeshGroup {
  std::uint32_t first_face = 0;
  std::string name;
};

namespace mesh_file {
class Output;  // filled by a reader (mesh_file/reading.hpp)
}

// A format. One file in mesh_file/ defines it; it is declared below and listed in mesh_file/mesh_file.cpp.
struct MeshFormat {
  std::string_view ending;   // of the file's name, in lower case: ".obj"
  std::string_view file;     // "an OBJ file"
  std::string_view content;  // "a polygon mesh (Wavefront OBJ)"
  bool text;                 // is it a text format? Then a zero byte shows that the file is not of this format
  // Can a line of this format begin with these three words (empty if there are fewer)? `first`: is it the first line of the file?
  bool (*begins)(std::span<const std::string_view, 3> words, bool first);
  void (*read)(std::string_view bytes, mesh_file::Output& out);
  std::string (*write)(const brep::Builder& builder, std::span<const MeshGroup> groups);
};

namespace mesh_file {
extern const MeshFormat obj_format, ply_format, off_format;  // each defined in a file of that folder
}
[[nodiscard]] std::span<const MeshFormat* const> mesh_formats();

// ".obj, .ply or .off"
[[nodiscard]] std::string mesh_endings();

// By the ending of the name, in upper or lower case; null if no format has it.
[[nodiscard]] const MeshFormat* mesh_format(std::string_view path);
[[nodiscard]] bool has_ending(std::string_view path, std::string_view ending);

[[nodiscard]] MeshResult read_mesh(std::string_view bytes, const MeshFormat& format);

// The bytes of the file; PLY is binary little-endian. Positions are written so that they read back exactly. Every corner must exist.
// Groups, sorted by first face, become objects in OBJ ("o name"); the other formats have no groups.
[[nodiscard]] std::string write_mesh(const brep::Builder& builder, const MeshFormat& format, std::span<const MeshGroup> groups = {});

}  // namespace apps
