// SPDX-License-Identifier: MIT
#pragma once

// halflight check MESH: counts, components, genus, volume, and every fault that keeps the mesh from being a closed surface.
//
// With --repair what can be repaired is repaired and told, and -o writes the result; then faults are what remains. Exit
// code: 0 without faults, 3 with faults or when the file cannot be understood, 1 when it cannot be read or written.

#include <string>

#include <CLI/CLI.hpp>

#include "apps/exit_code.hpp"

namespace apps {

struct CheckOptions {
  std::string mesh;
  std::string output;  // empty: none
  bool repair = false;
  bool all = false;  // lists at full length
};

void describe(CLI::App& command, CheckOptions& options);

[[nodiscard]] ExitCode run(const CheckOptions& options);

}  // namespace apps
