// SPDX-License-Identifier: MIT
#pragma once

// The light of a solution in a file (.light), from which further pictures of the scene are drawn without solving it again. It contains
// the source of the scene, and the mesh with its colours in full precision, so that these pictures are bit-identical.
//
//   "halflight light 3\n", key of the scene and "\n", then little-endian, without gaps:
//   uint64: number of bytes of the scene's source; these bytes
//   uint64: number of positions, of corners, of faces
//   a position: 3 double;   a corner: uint32 position, 3 double radiosity, 3 float normal
//   a face: uint32 first corner, number of corners, input surface; 3 double radiosity
//   checksum of all before, 16 hexadecimal digits
//
// The key is a checksum of the materials and of the objects' shapes; light of another scene is refused, and so is a damaged file.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/intake/to_scene.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// Everything from which a scene was read: its file, the files beside it, and the options of the command line. A .light file contains it,
// so that it is enough to draw pictures.
struct SceneSource {
  std::string path;  // its extension determines the format
  std::string text;
  std::vector<FileBeside> beside;
  ModelOptions options;
};

// Written by archive.hpp, in the order of the members.
[[nodiscard]] std::string to_bytes(const SceneSource& source);
// Nothing if the bytes are not those of a source.
[[nodiscard]] std::optional<SceneSource> read_scene_source(std::string_view bytes);

// Looks up the files beside the scene in the source, which must outlive the result.
[[nodiscard]] SideFile files_of(const SceneSource& source);

struct Light {
  radiosity::Mesh mesh;  // its faces do not refer to nodes of a hierarchy
  radiosity::Frame frame;
};

// The file's bytes for a valid scene that was read from `source`.
[[nodiscard]] std::string to_light_file(const radiosity::Mesh& mesh, const radiosity::Frame& frame, const radiosity::Scene& scene,
                                        const SceneSource& source);

struct LightResult {
  std::optional<Light> light;
  std::string reason;  // why there is none
};
[[nodiscard]] LightResult read_light_file(std::string_view bytes, const radiosity::Scene& scene);

// The source of the scene; if it is not in the file, nothing and a sentence in `reason`.
[[nodiscard]] std::optional<SceneSource> source_in_light_file(std::string_view bytes, std::string& reason);

}  // namespace apps
