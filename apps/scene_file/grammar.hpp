// SPDX-License-Identifier: MIT
#pragma once

// The words of the grammar. Kinds of objects are rows of one table, with their clauses and the function that makes their shape. A new
// primitive is one row in shapes.cpp and that function.

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "apps/input_errors.hpp"

namespace raycast {
class Object;
}

namespace apps::scene_file {

struct ObjectSyntax;
using Shape = std::shared_ptr<const raycast::Object>;
using Words = std::span<const std::string_view>;

// What follows the word of a clause: three numbers; one above 0; two numbers; a vertex; the vertex numbers of a face.
enum class Form { vector, length, pair, vertex, face };

struct Clause {
  std::string_view word;
  Form form;
  bool required = true;
};

struct ObjectKind {
  std::string_view word;
  std::vector<Clause>
      clauses;        // its own; those that all kinds have come on top: material, sheet, move, rotate, scale, inside; of a mesh file
  bool solid = true;  // encloses something, so that it can be seen from inside and be an operand
  // Makes the object in its own coordinates, or null after an error, at the responsible clause if there is one (the vertex farthest from
  // a polygon's plane, the face of a mesh, the second corner of a flat box). The statement must be valid. Null for unions, intersections
  // and differences, which make_csg() makes.
  Shape (*make)(const ObjectSyntax&, Errors&) = nullptr;
};

[[nodiscard]] inline bool is_csg(const ObjectKind& kind) { return kind.make == nullptr; }

// The table of all kinds (shapes.cpp).
[[nodiscard]] std::span<const ObjectKind> object_kinds();

// The kind of object whose statement begins with the word; null if there is none.
[[nodiscard]] const ObjectKind* kind_of(std::string_view word);

// Words with which a statement may begin.
[[nodiscard]] Words statements();

// Words that may follow the name of an object: its clauses; for unions, intersections and differences also operands.
[[nodiscard]] Words clause_words(const ObjectKind& kind);

inline constexpr std::array<std::string_view, 2> material_words = {"reflectance", "emission"};
inline constexpr std::array<std::string_view, 6> camera_words = {"eye", "target", "look", "up", "fov", "size"};
inline constexpr std::array<std::string_view, 3> use_words = {"move", "rotate", "scale"};

// May the clause occur several times in one statement?
[[nodiscard]] bool is_repeatable(std::string_view word);

// Can the word begin an operand?
[[nodiscard]] bool is_operand(std::string_view word);

}  // namespace apps::scene_file
