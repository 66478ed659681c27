// SPDX-License-Identifier: MIT
#pragma once

// Makes the raycast objects of unions, intersections and differences; those of all other kinds are made by the table of the grammar.

#include <memory>
#include <vector>

#include <raycast/object.hpp>

#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// A union, intersection or difference, and the shapes of its leaves in the order of the file, whose sheets are its sheets.
struct CsgShape {
  Shape whole;  // null after an error
  std::vector<Shape> leaves;
};
[[nodiscard]] CsgShape make_csg(const ObjectSyntax& syntax, Errors& errors);

}  // namespace apps::scene_file
