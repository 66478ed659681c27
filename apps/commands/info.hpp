// SPDX-License-Identifier: MIT
#pragma once

// halflight info SCENE: what is in a scene, without solving it.

#include <string>

#include <CLI/CLI.hpp>

#include "apps/exit_code.hpp"
#include "apps/scene_file.hpp"

namespace apps {

struct InfoOptions {
  std::string scene;
};

void describe(CLI::App& command, InfoOptions& options);

[[nodiscard]] ExitCode run(const InfoOptions& options);

}  // namespace apps
