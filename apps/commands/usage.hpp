// SPDX-License-Identifier: MIT
#pragma once

// What is wrong with a command line, in one sentence: an unknown word with the nearest that is known, an option without its value.

#include <optional>
#include <span>
#include <string>

#include <CLI/CLI.hpp>

namespace apps {

// `error` is what parsing `arguments` (without the program's name) threw.
[[nodiscard]] std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> arguments);

// An argument without a word in it, such as that of --json "" or --json=, in one sentence: no option takes it.
[[nodiscard]] std::optional<std::string> empty_argument(std::span<const char* const> arguments);

}  // namespace apps
