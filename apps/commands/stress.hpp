// SPDX-License-Identifier: MIT
#pragma once

// halflight stress [CASE...]: stiff and extreme scenes, each figure against its bound; exit code 1 when one fails.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/exit_code.hpp"

namespace apps {

struct StressOptions {
  std::vector<std::string> cases;  // none: all
  std::string json;
  bool list = false;
};

void describe(CLI::App& command, StressOptions& options);

[[nodiscard]] ExitCode run(const StressOptions& options);

}  // namespace apps
