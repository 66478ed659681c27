// SPDX-License-Identifier: MIT
#pragma once

// halflight study SCENE... -o DIR: error against time, memory and links for every method, measured on each scene.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/exit_code.hpp"

namespace apps {

struct StudyOptions {
  std::vector<std::string> scenes;
  std::string folder;
  double seconds = 12.0;       // CPU time of one run
  std::uint64_t paths = 8192;  // a point of the reference
  std::uint32_t dense = 3000;  // leaves up to which the parts of an error are told apart
  bool quick = false;
  bool quiet = false;
  unsigned threads = 0;
  std::optional<std::uint64_t> memory;  // bytes that a run may take
};

void describe(CLI::App& command, StudyOptions& options);

[[nodiscard]] ExitCode run(const StudyOptions& options);

}  // namespace apps
