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

}  // namespace apps::exercise
