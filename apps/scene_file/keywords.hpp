// SPDX-License-Identifier: MIT
#pragma once

// The words of the grammar: which statements there are, and which clauses each of them may have.

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

using Words = std::span<const std::string_view>;

inline constexpr std::array<std::string_view, 16> statements = {"material",     "camera",     "polygon", "disk",         "box",  "sphere",
                                                                "cylinder",     "cone",       "torus",   "superquadric", "mesh", "union",
                                                                "intersection", "difference", "define",  "use"};
inline constexpr std::array<std::string_view, 2> material_words = {"reflectance", "emission"};
inline constexpr std::array<std::string_view, 6> camera_words = {"eye", "target", "look", "up", "fov", "size"};
inline constexpr std::array<std::string_view, 3> use_words = {"move", "rotate", "scale"};

// No statement has more clauses than this.
inline constexpr std::size_t most_words = 18;

// What may follow the name of an object: its clauses; of unions, intersections and differences operands, too.
[[nodiscard]] Words clause_words(Kind kind);

// May the clause stand several times in one statement?
[[nodiscard]] bool is_repeatable(std::string_view word);

// Does the word begin an operand, where operands may stand?
[[nodiscard]] bool is_operand(std::string_view word);

[[nodiscard]] bool contains(Words words, std::string_view word);

// The kind of object whose statement begins with the word.
[[nodiscard]] std::optional<Kind> kind_of(std::string_view word);

}  // namespace apps::scene_file
