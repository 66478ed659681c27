// SPDX-License-Identifier: MIT
#pragma once

// halflight euler SCRIPT -o OUT.svg|OUT.html: plays a script of Euler operators and draws each step.
// halflight euler --interactive: reads the statements from the terminal.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/exit_code.hpp"

namespace apps {

struct EulerOptions {
  std::string script;
  std::vector<std::string> outputs;
  bool interactive = false;
};

void describe(CLI::App& command, EulerOptions& options);

[[nodiscard]] ExitCode run(const EulerOptions& options);

}  // namespace apps
