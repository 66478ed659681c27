// SPDX-License-Identifier: MIT
#pragma once

// A conversation: operators in, counts and refusals out. See examples/euler for the statements.

#include <string>
#include <vector>

#include "apps/exit_code.hpp"

namespace apps::euler {

// Reads lines from stdin until `quit` or the end. After each step every output is written anew: OUT.svg the present state, OUT.html
// all steps so far. Bad lines and refusals are told and change nothing; the exit code is ok unless a file cannot be written.
[[nodiscard]] ExitCode converse(const std::vector<std::string>& outputs);

}  // namespace apps::euler
