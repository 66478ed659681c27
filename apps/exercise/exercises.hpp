// SPDX-License-Identifier: MIT
#pragma once

// The exercises of examples/exercises: which there are, and what is still wrong with a student's file. A sentence names the first thing
// that does not hold; it never says how to mend it.

#include <optional>
#include <span>
#include <string>

namespace apps::exercise {

struct Exercise {
  const char* file;  // in examples/exercises, where the text and the beginning are
  const char* title;
  // What is wrong, or nothing. Null: a program, tested by examples/exercises/check.sh.
  std::optional<std::string> (*fault)(const std::string& text);
};

// Exercise n is all()[n - 1].
[[nodiscard]] std::span<const Exercise> all();
// The file as the student gets it.
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
