// SPDX-License-Identifier: MIT
#pragma once

// From statements to a scene: names are resolved, shapes made, groups placed.

#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// The scene of the statements. Its worth is nothing when errors were added.
[[nodiscard]] SceneFile build(const SceneSyntax& syntax, const SideFile& side_file, Errors& errors);

}  // namespace apps::scene_file
