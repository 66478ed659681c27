// SPDX-License-Identifier: MIT
#pragma once

// Guesses the kind of a file when a command was given the wrong one. One sentence can then name it and say what to do, instead of a
// parser's errors about text that was not meant for it. Called after reading has failed, so a guess never refuses a valid file.

#include <optional>
#include <string>
#include <string_view>

#include "apps/mesh_file.hpp"

namespace apps {

enum class FileKind { unknown, empty, scene, script, mesh, stl, light, other };

struct FileGuess {
  FileKind kind = FileKind::unknown;
  std::string what;                    // "a polygon mesh (PLY)", "a picture (PNG)"; empty if unknown
  const MeshFormat* format = nullptr;  // only for a mesh
};

// Guesses by the first bytes and words.
[[nodiscard]] FileGuess guess_kind(std::string_view bytes);

// A text STL file begins with "solid"; so do many binary ones, but these have a zero byte soon after.
[[nodiscard]] bool is_stl_text(std::string_view bytes);

// Returns the sentence if the file is neither a scene, nor a mesh of the format that its name says, nor a script of Euler operators.
// `wanted`: what it should have been; `format`: the format of a mesh, if known.
[[nodiscard]] std::optional<std::string> wrong_kind(const std::string& path, std::string_view bytes, FileKind wanted,
                                                    const MeshFormat* format = nullptr);

}  // namespace apps
