// SPDX-License-Identifier: MIT
#pragma once

// Makes the raycast objects that the statements of a scene file describe.

#include <memory>

#include <raycast/object.hpp>

#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// The object in its own coordinates, or null after an error at the clause that is to blame where one can be named
// (the vertex that lies farthest off a polygon's plane, the face of a mesh, the second corner of a flat box).
// `syntax` is sound.
[[nodiscard]] std::shared_ptr<const raycast::Object> make_shape(const ObjectSyntax& syntax, Errors& errors);

}  // namespace apps::scene_file
