// SPDX-License-Identifier: MIT
#pragma once

// halflight factors SCENE: the form factors between the surfaces of a scene, each with its error.

#include <string>

#include <CLI/CLI.hpp>

#include "apps/exit_code.hpp"
#include "apps/scene_file.hpp"

namespace apps {

struct FactorsOptions {
  std::string scene, csv, json, total_exchange;
  double error = 1e-3;
  unsigned threads = 0;
};

void describe(CLI::App& command, FactorsOptions& options);

[[nodiscard]] ExitCode run(const FactorsOptions& options);

}  // namespace apps
