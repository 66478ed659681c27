// SPDX-License-Identifier: MIT
#pragma once

// What the commands share.

#include <optional>
#include <string>

#include "apps/exit_code.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// Reads and parses; on failure prints every error to stderr and sets `code`.
[[nodiscard]] std::optional<SceneFile> load_scene(const std::string& path, ExitCode& code);

// One name for one file, however it was written: through '.', '..' and symbolic links.
[[nodiscard]] std::string resolved(const std::string& path);

// One line on stderr: "halflight: sentence".
void complain(const std::string& sentence);

}  // namespace apps
