// SPDX-License-Identifier: MIT
#pragma once

// Shared by the commands: reading scenes, checking outputs, and messages to the user.

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

inline constexpr std::size_t longest_list = 200;  // lines; of longer lists only the number of further items is printed

// The name of an input as it appears in a sentence.
[[nodiscard]] std::string shown(const std::string& input);

// Reads the whole file, "-" for the standard input; on failure prints the reason and sets `code` to failure.
[[nodiscard]] std::optional<std::string> load_text(const std::string& path, ExitCode& code);

// Reads a scene, or a file of another program (intake/model.hpp); on failure prints every error to stderr and sets `code`. A file of
// neither kind gets one sentence (file_kind.hpp). Refuses a scene that has read one of `outputs`, which would be overwritten.
[[nodiscard]] std::optional<SceneFile> load_scene(const std::string& path, const std::vector<std::string>& outputs, ExitCode& code,
                                                  const ModelOptions& options = {});
// Does the same for a text that has already been read.
[[nodiscard]] std::optional<SceneFile> load_scene(const std::string& path, const std::string& text, const std::vector<std::string>& outputs,
                                                  ExitCode& code, const ModelOptions& options = {});

// The scene contained in a .light file.
[[nodiscard]] std::optional<SceneFile> load_scene(const SceneSource& source, ExitCode& code);

// Refuses, before any work, outputs that cannot be written, that are an input, or that are the same file as another output
// (files.hpp). Empty names are ignored.
[[nodiscard]] ExitCode check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

// Does the same for a mesh, whose name must have the ending of a format; empty: no mesh is requested.
[[nodiscard]] ExitCode check_mesh_output(const std::string& output, std::vector<std::string> others, const std::string& input);

// Replaces the file; on failure prints the reason.
[[nodiscard]] bool save(const std::string& path, const std::string& bytes);

// Prints the text on the standard output, or on stderr if one of the outputs is the standard output. If it cannot be written, says so and
// returns false. A closed pipe is not a failure: its reader, such as `head`, has all that it wants.
[[nodiscard]] bool print(const std::string& text, const std::vector<std::string>& outputs = {});

// Prints one line on stderr: "halflight: sentence". With a code, returns it, so that a command can end with it.
void complain(const std::string& sentence);
ExitCode complain(const std::string& sentence, ExitCode code);

// Prints the faults of a scene, one line each: "name: error: sentence"; at most max_errors of them.
void complain_of(const std::string& name, const std::vector<std::string>& sentences);

}  // namespace apps
