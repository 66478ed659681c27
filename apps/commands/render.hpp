// SPDX-License-Identifier: MIT
#pragma once

// halflight render SCENE [-o OUT.png] [-o OUT.ply] ...: solves a scene, writes pictures and meshes, prints the report.
//
// What can be known to fail is refused before the solver starts: extensions, folders, the camera's name. Outputs are
// encoded in memory and then replace their files one by one, each whole (files.hpp).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <radiosity/options.hpp>

#include "apps/exit_code.hpp"
#include "apps/report.hpp"
#include "apps/scene_file.hpp"

namespace apps {

enum class ErrorOf { picture, surfaces };

struct RenderOptions {
  std::string scene;
  std::vector<std::string> outputs;  // *.png, *.ply
  std::string json;                  // empty: none
  std::string camera;                // empty: the first of the file, or the automatic one
  std::optional<PictureSize> size;
  std::optional<double> exposure;
  PictureMethod method = PictureMethod::mesh;
  bool quiet = false;
  std::optional<ErrorOf> error_of;      // default: of the picture when there is one
  std::optional<std::uint64_t> memory;  // bytes that the process may hold
  radiosity::Options solver;
};

// Adds the command's arguments; `options` must outlive the parsing.
void describe(CLI::App& command, RenderOptions& options);

[[nodiscard]] ExitCode run(const RenderOptions& options);

}  // namespace apps
