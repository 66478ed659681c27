// SPDX-License-Identifier: MIT
#pragma once

// Makes the raycast objects that the statements of a scene file describe.

#include <memory>
#include <vector>

#include <raycast/object.hpp>

#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// The object in its own coordinates, or null after an error at the clause that is to blame where one can be named
// (the vertex that lies farthest off a polygon's plane, the face of a mesh, the second corner of a flat box).
// `syntax` is sound, and no union, intersection or difference.
[[nodiscard]] std::shared_ptr<const raycast::Object> make_shape(const ObjectSyntax& syntax, Errors& errors);

[[nodiscard]] inline bool is_csg(Kind kind) { return kind == Kind::unite || kind == Kind::intersection || kind == Kind::difference; }

// A union, intersection or difference, and the shapes of its leaves in the order of the file, whose sheets are its sheets.
struct CsgShape {
  std::shared_ptr<const raycast::Object> whole;  // null after an error
  std::vector<std::shared_ptr<const raycast::Object>> leaves;
};
[[nodiscard]] CsgShape make_csg(const ObjectSyntax& syntax, Errors& errors);

}  // namespace apps::scene_file
