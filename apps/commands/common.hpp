// SPDX-License-Identifier: MIT
#pragma once

// What the commands share: reading a scene, checking where outputs go, and words to the user.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/file_kind.hpp"
#include "apps/intake/to_scene.hpp"
#include "apps/light_file.hpp"
#include "apps/process.hpp"
#include "apps/scene_file.hpp"

namespace apps {

inline constexpr std::size_t longest_list = 200;  // lines; of the others the number is said

// The name of an input in a sentence.
[[nodiscard]] std::string shown(const std::string& input);

// The whole file, "-" for the standard input; on failure says why and sets `code` to failure.
[[nodiscard]] std::optional<std::string> load_text(const std::string& path, ExitCode& code);

// Reads a scene, or a file of another program (intake/model.hpp); on failure prints every error to stderr and sets `code`. A file of
// neither kind gets one sentence (file_kind.hpp). A scene is refused that has read one of `outputs`, for it would be overwritten.
[[nodiscard]] std::optional<SceneFile> load_scene(const std::string& path, const std::vector<std::string>& outputs, ExitCode& code,
                                                  const ModelOptions& options = {});
// The same for a text that has been read already.
[[nodiscard]] std::optional<SceneFile> load_scene(const std::string& path, const std::string& text, const std::vector<std::string>& outputs,
                                                  ExitCode& code, const ModelOptions& options = {});

// The scene that a .light file holds.
[[nodiscard]] std::optional<SceneFile> load_scene(const SceneSource& source, ExitCode& code);

// Refuses, before any work, outputs that cannot be written, that are an input, or that are the same file as another output
// (files.hpp). Empty names are passed over.
[[nodiscard]] ExitCode check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

// The same for a mesh; its name must have the ending of a format. Empty: none is asked for.
[[nodiscard]] ExitCode check_mesh_output(const std::string& output, std::vector<std::string> others, const std::string& input);

// Replaces the file; on failure says why.
[[nodiscard]] bool save(const std::string& path, const std::string& bytes);

// Prints the text on the standard output, or on stderr when one of the outputs is the standard output. When it cannot be written, says so
// and returns false. A closed pipe is no failure: its reader, such as `head`, has all that it wants.
[[nodiscard]] bool print(const std::string& text, const std::vector<std::string>& outputs = {});

// One line on stderr: "halflight: sentence". With a code: gives it back, so that a command can end with it.
void complain(const std::string& sentence);
ExitCode complain(const std::string& sentence, ExitCode code);

// What is wrong with a scene, one line each: "name: error: sentence"; the first max_errors of them.
void complain_of(const std::string& name, const std::vector<std::string>& sentences);

}  // namespace apps
