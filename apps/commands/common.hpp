// SPDX-License-Identifier: MIT
#pragma once

// What the commands share: reading a scene, checking where outputs go, and words to the user.

#include <optional>
#include <string>
#include <vector>

#include "apps/exit_code.hpp"
#include "apps/file_kind.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// The name of an input in a sentence.
[[nodiscard]] std::string shown(const std::string& input);

// The whole file, "-" for the standard input; on failure says why and sets `code` to failure.
[[nodiscard]] std::optional<std::string> load_text(const std::string& path, ExitCode& code);

// Reads and parses; on failure prints every error to stderr and sets `code`. What is no scene at all gets one sentence.
[[nodiscard]] std::optional<SceneFile> load_scene(const std::string& path, ExitCode& code);
// The same of a text that is at hand.
[[nodiscard]] std::optional<SceneFile> load_scene(const std::string& path, const std::string& text, ExitCode& code);

// Outputs that are an input, or one another, or cannot be written, are refused before any work (output_paths.hpp). Empty names are none.
[[nodiscard]] ExitCode check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

// Replaces the file; on failure says why.
[[nodiscard]] bool save(const std::string& path, const std::string& bytes);

// The text for the user: to the standard output, or to stderr when one of the outputs is the standard output. False when it could not be
// written and this was said. A pipe that nobody reads any more is none of it: who reads no further has what was wanted.
[[nodiscard]] bool print(const std::string& text, const std::vector<std::string>& outputs = {});

// One line on stderr: "halflight: sentence".
void complain(const std::string& sentence);

// What is wrong with a scene, one line each: "name: error: sentence"; the first of many.
void complain_of(const std::string& name, const std::vector<std::string>& sentences);

}  // namespace apps
