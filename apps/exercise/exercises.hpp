// SPDX-License-Identifier: MIT
#pragma once

// The exercises of examples/exercises, and the check of a student's file. The sentence names the first thing that is wrong, but never how
// to correct it.

#include <optional>
#include <span>
#include <string>

namespace apps::exercise {

struct Exercise {
  const char* file;  // in examples/exercises, which contains the text and the initial file
  const char* title;
  // Says what is wrong, or nothing. Null for an exercise that is a program, tested by examples/exercises/check.sh.
  std::optional<std::string> (*fault)(const std::string& text);
};

// Exercise n is all()[n - 1].
[[nodiscard]] std::span<const Exercise> all();
// The initial file that the student gets.
[[nodiscard]] std::string beginning(const Exercise& exercise);

// --- exercises that are scripts of Euler operators: what is wrong with one, or nothing

[[nodiscard]] std::optional<std::string> tetrahedron(const std::string& text);
[[nodiscard]] std::optional<std::string> torus(const std::string& text);
[[nodiscard]] std::optional<std::string> holes(const std::string& text);
[[nodiscard]] std::optional<std::string> dual_of_prism(const std::string& text);
[[nodiscard]] std::optional<std::string> inverse(const std::string& text);
[[nodiscard]] std::optional<std::string> break_and_mend(const std::string& text);

// --- exercises worked out by hand, files of `name = number`: what is wrong with one, or nothing

[[nodiscard]] std::optional<std::string> form_factors(const std::string& text);
[[nodiscard]] std::optional<std::string> push_pull(const std::string& text);
[[nodiscard]] std::optional<std::string> t_vertex(const std::string& text);

}  // namespace apps::exercise
