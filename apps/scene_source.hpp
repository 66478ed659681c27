// SPDX-License-Identifier: MIT
#pragma once

// All that a scene was read from: its file, the files beside it, and what the command line said. A .light file holds it, so that pictures
// are drawn from that file alone.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/intake/to_scene.hpp"
#include "apps/scene_file.hpp"

namespace apps {

struct SceneSource {
  std::string path;  // its ending tells the format
  std::string text;
  std::vector<FileBeside> beside;
  ModelOptions options;
};

// Little-endian: texts with their lengths (uint64) before them, numbers as double, choices as one byte.
[[nodiscard]] std::string to_bytes(const SceneSource& source);
// Nothing when the bytes are not those of a source.
[[nodiscard]] std::optional<SceneSource> read_scene_source(std::string_view bytes);

// Finds the files beside the scene in the source, which must outlive the result.
[[nodiscard]] SideFile files_of(const SceneSource& source);

}  // namespace apps
