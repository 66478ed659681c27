// SPDX-License-Identifier: MIT
#pragma once

// Reads the command line by the rows of the commands, and runs the one that it names.

#include <vector>

#include "apps/commands/command.hpp"

namespace apps {

// `--help` and `--version` are answered; what is wrong with the command line is said in one sentence.
[[nodiscard]] ExitCode run_program(const std::vector<Command>& commands, int argc, char** argv);

}  // namespace apps
