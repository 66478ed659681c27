// SPDX-License-Identifier: MIT
#pragma once

// What is wrong with a command line, in one sentence: an unknown word with the nearest that is known, an option without its value.

#include <span>
#include <string>

#include <CLI/CLI.hpp>

namespace apps {

// `error` is what parsing `arguments` (without the program's name) threw.
[[nodiscard]] std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> arguments);

}  // namespace apps
