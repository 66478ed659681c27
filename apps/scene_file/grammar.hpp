// SPDX-License-Identifier: MIT
#pragma once

// The words of the grammar. Kinds of objects are rows of one table, with the clauses that each of them has and what makes its shape. A new
// primitive is one row in shapes.cpp, and the function that it names.

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

// What follows the word of a clause: three numbers, one above 0, two numbers; a vertex of a list, the numbers of the corners of a face.
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
  // The object in its own coordinates, or null after an error at the clause that is to blame where one can be named (the vertex that lies
  // farthest off a polygon's plane, the face of a mesh, the second corner of a flat box). The statement is sound. Unions, intersections
  // and differences have none: make_csg() makes them.
  Shape (*make)(const ObjectSyntax&, Errors&) = nullptr;
};

[[nodiscard]] inline bool is_csg(const ObjectKind& kind) { return kind.make == nullptr; }

// The table (shapes.cpp).
[[nodiscard]] std::span<const ObjectKind> object_kinds();

// The kind of object whose statement begins with the word; null when there is none.
[[nodiscard]] const ObjectKind* kind_of(std::string_view word);

// What may begin a statement.
[[nodiscard]] Words statements();

// What may follow the name of an object: its clauses; of unions, intersections and differences operands, too.
[[nodiscard]] Words clause_words(const ObjectKind& kind);

inline constexpr std::array<std::string_view, 2> material_words = {"reflectance", "emission"};
inline constexpr std::array<std::string_view, 6> camera_words = {"eye", "target", "look", "up", "fov", "size"};
inline constexpr std::array<std::string_view, 3> use_words = {"move", "rotate", "scale"};

// May the clause stand several times in one statement?
[[nodiscard]] bool is_repeatable(std::string_view word);

// Does the word begin an operand, where operands may stand?
[[nodiscard]] bool is_operand(std::string_view word);

[[nodiscard]] bool contains(Words words, std::string_view word);

}  // namespace apps::scene_file
