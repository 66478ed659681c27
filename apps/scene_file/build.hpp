// SPDX-License-Identifier: MIT
#pragma once

// From statements to a scene: names are resolved, shapes made, groups placed.

#include <vector>

#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// The scene of the statements. Not to be used when errors were added.
[[nodiscard]] SceneFile build(const SceneSyntax& syntax, const SideFile& side_file, Errors& errors);

// A camera whose syntax is sound, with its direction upwards.
[[nodiscard]] radiosity::Camera make_camera(const CameraSyntax& syntax, Errors& errors);

// (csg.cpp) A union, intersection or difference, and the shapes of its leaves in the order of the file, whose sheets are its sheets.
struct CsgShape {
  Shape whole;  // null after an error
  std::vector<Shape> leaves;
};
[[nodiscard]] CsgShape make_csg(const ObjectSyntax& syntax, Errors& errors);

}  // namespace apps::scene_file
