// SPDX-License-Identifier: MIT
#pragma once

// Guesses what a file is when a command was given the wrong one, so that one sentence can name it and say what to do, in place of a
// parser's errors about text that was not meant for it. It is asked after reading has failed, so that no sound file is refused by a guess.

#include <optional>
#include <string>
#include <string_view>

#include "apps/mesh_file.hpp"

namespace apps {

enum class FileKind { unknown, empty, scene, script, mesh, stl, light, other };

struct FileGuess {
  FileKind kind = FileKind::unknown;
  std::string what;                    // "a polygon mesh (PLY)", "a picture (PNG)"; empty when unknown
  const MeshFormat* format = nullptr;  // of a mesh
};

// By the first bytes and words.
[[nodiscard]] FileGuess guess_kind(std::string_view bytes);

// STL as text begins with "solid"; so do many binary files, which have a zero byte soon.
[[nodiscard]] bool is_stl_text(std::string_view bytes);

// The sentence, when the file is something else than a scene, a mesh of the format that its name says, or a script of Euler operators.
// `wanted` is what it should have been, `format` the format of a mesh, where it is known.
[[nodiscard]] std::optional<std::string> wrong_kind(const std::string& path, std::string_view bytes, FileKind wanted,
                                                    const MeshFormat* format = nullptr);

}  // namespace apps
