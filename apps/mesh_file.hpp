// SPDX-License-Identifier: MIT
#pragma once

// Polygon meshes from files: OBJ (Wavefront), PLY (Turk 1994: ascii, binary little and big endian), OFF (Geomview: OFF, COFF,
// NOFF, STOFF and their combinations). Positions and faces are read into a builder, everything else is passed over.
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

#include <brep/builder_input.hpp>

#include "apps/scene_file.hpp"

namespace apps {

enum class MeshFormat { obj, ply, off };

// By the ending of the name: .obj, .ply or .off in any case.
[[nodiscard]] std::optional<MeshFormat> mesh_format(std::string_view path);

struct Mesh {
  brep::Builder builder;
  std::vector<std::uint32_t> vertex_line, face_line;  // where each stands in the file; empty for binary files
  std::vector<std::string> notes;                     // what was passed over and may matter
};

struct MeshError {
  Place place;  // in a binary file: line 0, and in place of the column the byte, from 1
  std::string sentence;
};

struct MeshResult {
  std::optional<Mesh> mesh;       // nothing when there are errors
  std::vector<MeshError> errors;  // in the order of the file
  bool more_errors = false;       // reading was given up at max_errors
};

[[nodiscard]] MeshResult read_mesh(std::string_view bytes, MeshFormat format);

// One line per error: "box.obj:12:8: error: ..."; the last line says so when more were found.
[[nodiscard]] std::string to_text(const MeshResult& result, std::string_view name);

// Faces that belong together, up to where the next group begins.
struct MeshGroup {
  std::uint32_t first_face = 0;
  std::string name;
};

// The file's bytes; PLY is binary little endian. Positions are written so that they read back exactly. Every corner must exist.
// Groups, by rising first face, become objects in OBJ ("o name"); the other formats have no such thing.
[[nodiscard]] std::string write_mesh(const brep::Builder& builder, MeshFormat format, std::span<const MeshGroup> groups = {});

}  // namespace apps
